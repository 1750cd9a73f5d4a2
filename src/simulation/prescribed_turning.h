// How far functions of time turn what they drive. A pose does not tell whole turns: a step in which a MOTION goes once
// around and rests at both ends looks like none.
#pragma once

#include <vector>

#include "system/system.h"

namespace dynalin {

class PrescribedTurning {
 public:
  explicit PrescribedTurning(const System&);

  // The step from a point, at most `longest`, in which no MOTION of an angle turns by much more than `most` [rad]: one
  // way or the other, as rates at some instants of the step tell, nor from its beginning to its end, as the function
  // itself does. A jump of a function is none of its turns.
  double step(const OperatingPoint& from, double longest, double most);

 private:
  double step_by_rates(const OperatingPoint& from, double longest, double most);
  double step_by_ends(const OperatingPoint& from, double longest, double most);
  // Of all rows that drive an angle, where it is at an instant after the point.
  std::vector<double> angles(const OperatingPoint& from, double since);

  const System& system_;
  std::vector<std::size_t> turning_;  // rows
  ConstraintRows rows_;
  std::vector<double> rates_;  // of states
};

}  // namespace dynalin

// How far functions of time turn what they drive. A pose does not tell whole turns: a step in which a MOTION goes once
// around and rests at both ends looks like none.
#pragma once

#include <vector>

#include "system/system.h"

namespace dynalin {

class PrescribedTurning {
 public:
  explicit PrescribedTurning(const System&);

  // The step from a point, at most `longest`, in which no MOTION of an angle turns by much more than `most` [rad] one
  // way or the other, as rates at some instants of the step tell.
  double step(const OperatingPoint& from, double longest, double most);

 private:
  std::vector<std::size_t> angles() const;

  const System& system_;
  std::vector<std::size_t> prescribed_;  // rows
  std::vector<bool> rotates_;            // of each coordinate
  ConstraintRows rows_;
  std::vector<double> rates_;  // of states
};

}  // namespace dynalin

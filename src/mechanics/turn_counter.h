// Counts the whole turns of angles, at accepted points, whoever reads them.
#pragma once

#include <vector>

#include "mechanics/marker_frame.h"
#include "mechanics/signals.h"

namespace dynalin {

// AX, AY or AZ of axes I seen from axes J, both global: from −π to π, NaN where it has no value.
double principal_angle(Measure, const Matrix3& I, const Matrix3& J);

class TurnCounter {
 public:
  TurnCounter() = default;
  // Of all angles that the layout counts.
  explicit TurnCounter(const Signals&);

  // Takes the total angles of an accepted point into the memory. Where one has no value its turns stay.
  void remember(const Motion&, Memory&) const;

 private:
  struct Counted {
    Measure measure;
    MarkerFrame i, j;
    std::size_t memory;
  };
  std::vector<Counted> angles_;
};

}  // namespace dynalin

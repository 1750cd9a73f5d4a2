// Which violations of constraint rows are none.
#pragma once

#include <algorithm>

namespace dynalin {

// Of positions, relative to the scale of the row (row_scale) or to the model's length and radians: nothing but rounding
// keeps Newton's method from it.
inline constexpr double position_tolerance = 1e-13;

// Whether a redundant row of positions follows from the others: its violation and its rounding [of its scale] against
// what redundant rows may be off.
inline bool contradicts(double violation, double rounding, double redundancy_tolerance) {
  constexpr double margin = 1 + 1e-6;  // what is off by the tolerance itself follows, however that is computed
  return !(violation <= margin * std::max(redundancy_tolerance, position_tolerance) + rounding);
}

}  // namespace dynalin

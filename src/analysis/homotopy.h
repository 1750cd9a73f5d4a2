// Homotopy of the equations of rest F(x) = 0 from a point x₀ that is not at rest: the curve
//
//     H(x, s) = F(x) − (1 − s) r = 0,    r = F(x₀),
//
// starts at (x₀, 0) with the imbalance r as a load that holds the point, and is an equilibrium wherever s = 1. It is
// followed by its arc length, so that it may turn back in s where a branch of equilibria under partial load ends.
#pragma once

#include <optional>

#include "analysis/static_equations.h"

namespace dynalin {

struct HomotopyOptions {
  int step_limit = 250;        // along the curve
  double longest_step = 0.25;  // of arc length: model lengths, radians, units of states and of s
};

// The first equilibrium on the curve in the direction of growing s (`forward`) or the other; nothing if the curve
// leaves the region where it can be followed, or is longer than the limit.
std::optional<OperatingPoint> follow_to_rest(StaticEquations&, const OperatingPoint& start, bool forward,
                                             const HomotopyOptions& = {});

}  // namespace dynalin

// The trust-region least-squares search of Levenberg and Marquardt for the equations of rest,
//
//     minimize |r + J δ|² + μ |δ|²  with the constraints met to first order,
//
// in comparable units. Unlike a motion it cannot circle: the sum of squares falls with every step, so that it finds
// equilibria around which forces that do no conservative work would drive a damped motion for ever. It may end where
// the sum of squares is least but not zero.
#pragma once

#include "analysis/static_equations.h"

namespace dynalin {

// Moves the point; whether the sum of squares went below what Newton's method needs to finish.
bool reduce_imbalance(StaticEquations&, OperatingPoint&, int step_limit);

}  // namespace dynalin

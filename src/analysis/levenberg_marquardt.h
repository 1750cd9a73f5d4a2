// The trust-region least-squares search of Levenberg and Marquardt for the equations of rest,
//
//     minimize |r + J δ|² + μ |δ|²  with the constraints met to first order,
//
// in comparable units. Unlike a motion it cannot circle: the sum of squares falls with every step, so that it finds
// equilibria around which forces that do no conservative work would drive a damped motion for ever. It may end where
// the sum of squares is least but not zero.
//
// Where forces jump, as those of a contact whose normal passes from the face of one body to that of the other, walls
// lie across the way down. Steps that may climb get over them: they need only stay below what the last few began with.
#pragma once

#include "analysis/static_equations.h"

namespace dynalin {

enum class StepsMay : bool { fall, climb };

// Moves the point; whether the sum of squares went below what Newton's method needs to finish.
bool reduce_imbalance(StaticEquations&, OperatingPoint&, int step_limit, StepsMay = StepsMay::fall);

}  // namespace dynalin

// Reactions and algebraic values of a point that is to be searched from: constraints met, then
//
//     D a = F + Gᵀλ,  G a = 0,  w = e
//
// at rest, with the metric D that a tangent holds with (static_equations.h); the imbalance that is left, −D a, does no
// work on the reactions.
#pragma once

#include "analysis/static_equations.h"

namespace dynalin {

// Leaves the point as it is if that fails.
void settle(StaticEquations&, OperatingPoint&);

// The same of a point that a motion has led to. What it leaves of reactions and values that nothing keeps up at rest is
// rounding, and none is kept: each step would leave a smaller rest, of which a search took the size for that of what is
// at play, down to 1e-272.
void settle_after_motion(StaticEquations&, OperatingPoint&);

}  // namespace dynalin

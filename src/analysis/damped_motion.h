// Dynamic relaxation: rest is where a damped motion of the model with its own masses comes to.
//
//     M a + (C + c) u + r(q) = 0,   Φ(q) = 0
//
// in implicit steps of Euler's formula, u = δ/h, a = (u − u₀)/h, with the damping C that the model has at rest and the
// global damping c. Where the kinetic energy has passed its peak the velocities are taken away, for beyond it the
// motion climbs. Steps grow as long as the linear model foretells the forces along them; as h grows without end a
// step becomes Newton's. Unlike a search downhill it passes what it has the speed for.
#pragma once

#include <functional>

#include "analysis/static_equations.h"
#include "analysis/static_history.h"
#include "analysis/statics.h"

namespace dynalin {

// Moves the point. `at_rest` is asked wherever the motion has become slow or the imbalance small; the motion ends when
// it says yes, which is the result, after some hundred steps, or when the equations have taken all of the effort.
bool relax_by_motion(StaticEquations&, OperatingPoint&, const DampedMotion&, StaticHistory&, double effort_limit,
                     const std::function<bool(OperatingPoint&)>& at_rest);

}  // namespace dynalin

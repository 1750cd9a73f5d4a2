// Static equilibrium: poses, multipliers, algebraic values and states at which all velocities, accelerations and state
// rates are zero.
//
// Damped Newton on all unknowns at once; where the tangent is singular (free or indifferent freedoms, pure
// integrators) or a step does not help, a pseudo-transient term holds the point and fades with the residual. A point
// that is balanced to rounding is accepted as it stands.
#pragma once

#include "analysis/initial.h"

namespace dynalin {

struct StaticsOptions {
  int iteration_limit = 500;
  double rotation_limit = 0.17453292519943295;  // [rad] a step, ALIMIT
  int restarts = 24;  // of the search from other places, after all else
};

struct StaticsReport {
  int iterations = 0;
  double imbalance = 0;  // largest unbalanced force or moment/length at the end
};

// From the pose and states of `start`; its velocities are set to zero.
Result<OperatingPoint> find_equilibrium(const System&, OperatingPoint start, const StaticsOptions&, StaticsReport&,
                                        Findings&);

// The same with everything that belongs to an operating point: at t = 0 the dataset's velocities come back at the new
// pose (not with the environment variable MSC_ADAMS_STATICS_NO_RESTORE_VELOCITIES), then accelerations and reactions.
Result<OperatingPoint> static_operating_point(const System&, OperatingPoint start, const StaticsOptions&,
                                              StaticsReport&, Findings&);

}  // namespace dynalin

// Static equilibrium: poses, multipliers, algebraic values and states at which all velocities, accelerations and state
// rates are zero.
//
// The search, each step only where the one before it fails: (1) downhill, by Newton's method and implicit steps of a
// damped motion (`static_descent.h`); (2) least squares (`least_imbalance.h`); (3) continuation (`continuation.h`); (4)
// least squares from other places. A point that is balanced to rounding is accepted as it stands. What cannot be found
// is explained (`static_refusal.h`).
#pragma once

#include "analysis/initial.h"
#include "analysis/static_history.h"

namespace dynalin {

struct StaticsOptions {
  int iteration_limit = 500;
  double rotation_limit = 0.17453292519943295;  // [rad] a step, ALIMIT
  bool restore_velocities = true;               // the dataset's velocities come back at t = 0
  int restarts = 24;                            // of the search from other places, after all else
  double effort_limit = 1e10;                   // products, some ten seconds: what was not found by then is not
  StaticProgress progress{};                    // called with every iteration
};

struct StaticsReport {
  int iterations = 0;
  double imbalance = 0;      // largest unbalanced force or moment/length at the end
  OperatingPoint at_rest{};  // the solution itself: no velocities, accelerations and rates (static_operating_point)
};

// From the pose and states of `start`; its velocities are set to zero.
Result<OperatingPoint> find_equilibrium(const System&, OperatingPoint start, const StaticsOptions&, StaticsReport&,
                                        Findings&);

// The same with everything that belongs to an operating point: at t = 0 the dataset's velocities come back at the new
// pose if they are to be restored, then accelerations, reactions and rates are those of the moving model.
Result<OperatingPoint> static_operating_point(const System&, OperatingPoint start, const StaticsOptions&,
                                              StaticsReport&, Findings&);

}  // namespace dynalin

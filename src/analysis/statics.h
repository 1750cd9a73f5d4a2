// Static equilibrium: poses, multipliers, algebraic values and states at which all velocities, accelerations and state
// rates are zero.
//
// The search, each step only where the one before it fails: (1) downhill, by Newton's method and implicit steps of a
// damped motion (`static_descent.h`); (2) least squares (`levenberg_marquardt.h`); (3) Newton's method as it is
// (`original_method.h`); (4) continuation (`homotopy.h`); (5) a damped motion with the model's masses
// (`damped_motion.h`); (6) least squares in steps that may climb; (7) least squares from other places. (3) or (5) come
// before all of them where they are asked for. A point with a joint turned over is none (`turned_over.h`), and from a
// saddle that loads push off the search goes on downhill (`pushed_away.h`). A point that is balanced to rounding is
// accepted as it stands. What nothing holds there and something did at first must be free where it was at first
// (`first_freedoms.h`). A tolerance that is stated never ends the search early, but before (7) a point within it is
// accepted. What cannot be found is explained (`static_refusal.h`, `unheld_motion.h`).
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "analysis/displace.h"
#include "analysis/initial.h"
#include "analysis/static_history.h"

namespace dynalin {

// What is taken for an equilibrium where no exact one is found near the first point; nothing is unless it is stated.
struct StaticTolerance {
  double error = 1e-4;      // ERROR: Newton's step there, in lengths of the model, radians and sizes of states
  double imbalance = 1e-4;  // IMBALANCE: any unbalanced force, or moment by length
};

// METHOD=ORIGINAL: Newton's method as it is, within limits.
struct OriginalMethod {
  int iteration_limit = 25;
  double stability = 1e-5;    // of the mass and damping matrices, added to the stiffness
  std::vector<bool> pattern;  // whether an iteration evaluates the Jacobian, over and over; empty: each does
  StepLimits limits{0.17453292519943295, 20};
  StaticTolerance tolerance{};  // both must be met
};

// DYNAMIC: a damped motion of the model with its own masses, as the first search.
struct DampedMotion {
  double global_damping = 0;         // of every coordinate [force·time/length]
  double acceleration_error = 1e-2;  // below both, rest is looked for by Newton's method
  double kinetic_energy_error = 1e-2;
  double longest_time = std::numeric_limits<double>::infinity();
};

struct StaticsOptions {
  int iteration_limit = 500;
  StepLimits limits{0.17453292519943295};  // of a step downhill: ALIMIT, TLIMIT
  bool restore_velocities = true;          // the dataset's velocities come back at t = 0
  int restarts = 24;                       // of the search from other places, after all else
  double effort_limit = 1e10;              // products, some ten seconds: what was not found by then is not
  StaticProgress progress{};               // called with every iteration
  std::optional<StaticTolerance> tolerance;
  std::optional<OriginalMethod> original;  // the first search, where asked for
  std::optional<DampedMotion> motion;
  Progress told{};  // what is being done: which search, how far it is
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

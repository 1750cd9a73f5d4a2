// What a dataset sets for analyses and output, as far as anything here acts on it. A value that is not stated leaves
// the analysis its own.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"

namespace dynalin {

// EQUILIBRIUM: what static analyses iterate with.
struct EquilibriumSettings {
  std::optional<double> error, imbalance, stability;
  std::optional<double> translation_limit;  // TLIMIT [length]
  std::optional<double> rotation_limit;     // ALIMIT [rad]
  std::optional<std::int64_t> iteration_limit;
  std::optional<std::vector<bool>> pattern;  // of iterations, over and over: whether the Jacobian is evaluated anew
  std::optional<bool> newton;                // METHOD: ORIGINAL, or another
  std::optional<bool> by_motion;             // DYNAMIC, or STATIC
  std::optional<double> global_damping, acceleration_error, kinetic_energy_error;
  std::optional<double> settling_time;  // SETTLING_TIME, TEND: the longest that a damped motion may last [time]
};

// IC: what the analyses of initial conditions iterate with.
struct InitialConditionSettings {
  std::optional<double> error;  // of redundant rows, in their scales
  std::optional<double> velocity_error, acceleration_error;
  std::optional<double> translation_limit, rotation_limit;  // TLIMIT [length], ALIMIT [rad]
  std::optional<std::int64_t> iteration_limit, acceleration_iteration_limit;
};

// INTEGRATOR: how dynamics integrates.
struct IntegratorSettings {
  std::optional<std::string> type, formulation,
      corrector;                // as named, GSTIFF, SI2: SUNDIALS IDA integrates whatever they say
  std::optional<double> error;  // of a step, relative and absolute
  std::optional<double> largest_step, first_step, least_step;  // HMAX, HINIT, HMIN [time]
  std::optional<std::int64_t> largest_order, iteration_limit;  // KMAX, MAXIT
  std::optional<bool> interpolate;                             // steps may go beyond the next output
};

// KINEMATICS: what kinematic analyses iterate with.
struct KinematicsSettings {
  std::optional<double> error, acceleration_error;
  std::optional<double> translation_limit, rotation_limit;  // TLIMIT [length], ALIMIT [rad]
  std::optional<double> largest_step;                       // HMAX [time]
  std::optional<std::int64_t> iteration_limit, acceleration_iteration_limit;
};

// RESULTS: contents of the results file.
struct ResultsSettings {
  bool xrf = false;
  bool without_linear = false;  // NOLINEAR
  bool without_displacements = false, without_velocities = false, without_accelerations = false;
  bool without_reactions = false, without_forces = false, without_system_elements = false;
  std::optional<std::int64_t> decimal_places;
};

struct Settings {
  EquilibriumSettings equilibrium;
  InitialConditionSettings initial_conditions;
  IntegratorSettings integrator;
  KinematicsSettings kinematics;
  ResultsSettings results;
  std::optional<bool> prints_iterations;  // DEBUG: EPRINT, NOEPRINT
  std::vector<std::string> passed_over;   // "INTEGRATOR/HMAX": stated, and nothing acts on it
  Diagnostics remarks;                    // worth a sentence in every run

  // Once, however often it is stated.
  void pass_over(const std::string& name) {
    if (std::ranges::find(passed_over, name) == passed_over.end()) passed_over.push_back(name);
  }
};

// Values that `later` states replace those of `earlier`.
template <class T>
void take_over(std::optional<T>& earlier, const std::optional<T>& later) {
  if (later) earlier = later;
}
inline void take_over(EquilibriumSettings& earlier, const EquilibriumSettings& later) {
  take_over(earlier.error, later.error), take_over(earlier.imbalance, later.imbalance);
  take_over(earlier.stability, later.stability), take_over(earlier.translation_limit, later.translation_limit);
  take_over(earlier.rotation_limit, later.rotation_limit), take_over(earlier.iteration_limit, later.iteration_limit);
  take_over(earlier.pattern, later.pattern), take_over(earlier.newton, later.newton);
  take_over(earlier.by_motion, later.by_motion), take_over(earlier.global_damping, later.global_damping);
  take_over(earlier.acceleration_error, later.acceleration_error);
  take_over(earlier.kinetic_energy_error, later.kinetic_energy_error);
  take_over(earlier.settling_time, later.settling_time);
}
inline void take_over(IntegratorSettings& earlier, const IntegratorSettings& later) {
  take_over(earlier.type, later.type), take_over(earlier.formulation, later.formulation);
  take_over(earlier.corrector, later.corrector), take_over(earlier.error, later.error);
  take_over(earlier.largest_step, later.largest_step), take_over(earlier.first_step, later.first_step);
  take_over(earlier.least_step, later.least_step), take_over(earlier.largest_order, later.largest_order);
  take_over(earlier.iteration_limit, later.iteration_limit), take_over(earlier.interpolate, later.interpolate);
}
inline void take_over(KinematicsSettings& earlier, const KinematicsSettings& later) {
  take_over(earlier.error, later.error), take_over(earlier.acceleration_error, later.acceleration_error);
  take_over(earlier.translation_limit, later.translation_limit);
  take_over(earlier.rotation_limit, later.rotation_limit), take_over(earlier.largest_step, later.largest_step);
  take_over(earlier.iteration_limit, later.iteration_limit);
  take_over(earlier.acceleration_iteration_limit, later.acceleration_iteration_limit);
}
inline void take_over(InitialConditionSettings& earlier, const InitialConditionSettings& later) {
  take_over(earlier.error, later.error), take_over(earlier.velocity_error, later.velocity_error);
  take_over(earlier.acceleration_error, later.acceleration_error);
  take_over(earlier.translation_limit, later.translation_limit);
  take_over(earlier.rotation_limit, later.rotation_limit), take_over(earlier.iteration_limit, later.iteration_limit);
  take_over(earlier.acceleration_iteration_limit, later.acceleration_iteration_limit);
}

}  // namespace dynalin

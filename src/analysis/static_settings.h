// What EQUILIBRIUM states, as far as statics has the setting.
#pragma once

#include <algorithm>

#include "analysis/stated_limit.h"
#include "analysis/statics.h"
#include "model/settings.h"

namespace dynalin {

inline StaticsOptions statics_options(const EquilibriumSettings& s) {
  constexpr std::int64_t most_iterations = 1'000'000;
  StaticsOptions options;
  OriginalMethod original;
  if (s.iteration_limit)
    options.iteration_limit = original.iteration_limit =
        static_cast<int>(std::min(*s.iteration_limit, most_iterations));
  for (StepLimits* limits : {&options.limits, &original.limits}) {
    limits->rotation = stated_limit(s.rotation_limit, limits->rotation);
    limits->translation = stated_limit(s.translation_limit, limits->translation);
  }
  original.tolerance.error = s.error.value_or(original.tolerance.error);
  original.tolerance.imbalance = s.imbalance.value_or(original.tolerance.imbalance);
  if (s.error || s.imbalance) options.tolerance = original.tolerance;
  original.stability = s.stability.value_or(original.stability);
  original.pattern = s.pattern.value_or(original.pattern);
  // STABILITY and PATTERN belong to Newton's method and ask for it, unless another is named.
  if (s.newton.value_or(s.stability || s.pattern)) {
    options.original = original;
    options.iteration_limit = StaticsOptions{}.iteration_limit;  // MAXIT is Newton's then
  }
  if (s.by_motion.value_or(false)) {
    DampedMotion& motion = options.motion.emplace();
    motion.global_damping = s.global_damping.value_or(motion.global_damping);
    motion.acceleration_error = s.acceleration_error.value_or(motion.acceleration_error);
    motion.kinetic_energy_error = s.kinetic_energy_error.value_or(motion.kinetic_energy_error);
    motion.longest_time = stated_limit(s.settling_time, motion.longest_time);
    options.original.reset();
  }
  return options;
}

}  // namespace dynalin

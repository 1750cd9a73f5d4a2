// What EQUILIBRIUM states, as far as statics has the setting.
#pragma once

#include <algorithm>

#include "analysis/statics.h"
#include "model/settings.h"

namespace dynalin {

inline StaticsOptions statics_options(const EquilibriumSettings& s) {
  constexpr std::int64_t most_iterations = 1'000'000;
  StaticsOptions options;
  if (s.iteration_limit) options.iteration_limit = static_cast<int>(std::min(*s.iteration_limit, most_iterations));
  if (s.rotation_limit && *s.rotation_limit > 0) options.limits.rotation = *s.rotation_limit;
  if (s.translation_limit && *s.translation_limit > 0) options.limits.translation = *s.translation_limit;
  if (s.error || s.imbalance) {
    StaticTolerance& tolerance = options.tolerance.emplace();
    tolerance.error = s.error.value_or(tolerance.error);
    tolerance.imbalance = s.imbalance.value_or(tolerance.imbalance);
  }
  return options;
}

}  // namespace dynalin

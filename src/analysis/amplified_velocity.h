// Near a dead centre a stated velocity may be possible, and only by far larger ones elsewhere.
#pragma once

#include <span>

#include "analysis/velocity_conditions.h"

namespace dynalin {

// All velocities without and with what is stated.
struct StatedChange {
  const Eigen::VectorXd &before, &after;
};

// Warns where keeping what is stated takes velocities that are much larger, by the name of what takes most of them and
// of the part that moves most. `multipliers`: of the stated conditions, in the least change that meets them.
void warn_of_amplified_velocity(const System&, const Motion&, const StatedChange&,
                                std::span<const VelocityCondition> stated,
                                const Eigen::Ref<const Eigen::VectorXd>& multipliers, Diagnostics& warnings);

}  // namespace dynalin

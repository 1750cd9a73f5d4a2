// How a step of a search for rest moves a point: coordinates as far as limits and shapes allow, all else by as much.
#pragma once

#include <Eigen/Core>

#include "analysis/augmented_system.h"
#include "analysis/displace.h"
#include "system/system.h"

namespace dynalin {

// The point moved by fraction · step, less where that is beyond the limits. `taken` becomes the factor of the step that
// was gone.
OperatingPoint moved(const System&, const OperatingPoint&, const AugmentedSystem&, const Eigen::VectorXd& step,
                     double fraction, const StepLimits&, double* taken = nullptr);

}  // namespace dynalin

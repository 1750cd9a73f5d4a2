// Whether a small disturbance of an equilibrium grows.
#pragma once

#include "dynalin/operating_state.h"
#include "linear/linear_system.h"

namespace dynalin {

// By the eigenvalues of the linear model there; not known of models so large that they would take long.
Stability stability_of(const System&, const OperatingPoint& at_rest);

}  // namespace dynalin

// What is known of a system at a point, as the plain value that programs and writers get.
#pragma once

#include <optional>

#include "dynalin/operating_state.h"
#include "system/system.h"

namespace dynalin {

OperatingState operating_state(const System&, const OperatingPoint&);
// The same without the rows of constraints: telling which of them are redundant costs more than all else, too much for
// every step of a simulation.
OperatingState state_over_time(const System&, const OperatingPoint&);

// The value of VARIABLE/id, nothing where there is none.
std::optional<double> variable_value(const System&, const OperatingPoint&, std::int64_t id);

// ψ, θ, φ with R = Rz(ψ) Rx(θ) Rz(φ) and 0 ≤ θ ≤ π. Where z is vertical only ψ ± φ is determined, and φ is 0.
Triple angles_313(const Matrix3& R);

}  // namespace dynalin

// Constraint rows whose gradient is no finite number: of functions that have no derivative where the model stands.
#pragma once

#include <optional>
#include <string>

#include "system/system.h"

namespace dynalin {

// A sentence that names the first of them, and the function; nothing if all have a gradient, and finite rates of the
// given order by time along the motion.
std::optional<std::string> undefined_row(const System&, const Motion&, const ConstraintRows&, int order = 0);

// What is known of an element among the undefined_values of a system; empty if nothing is.
std::string undefined_value_of(const std::vector<UndefinedValue>&, const ElementLabel&);

}  // namespace dynalin

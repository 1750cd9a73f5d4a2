#pragma once

#include "system/operating_point.h"

namespace dynalin {

// The BCS of body k, whose first coordinate is `offset`, goes on at another point of the body, `by` along its axes.
void move_origin(OperatingPoint&, std::size_t k, std::int32_t offset, const Vector& by);

}  // namespace dynalin

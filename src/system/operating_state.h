// What is known of a system at a point, as the plain value that programs and writers get.
#pragma once

#include "dynalin/operating_state.h"
#include "system/system.h"

namespace dynalin {

OperatingState operating_state(const System&, const OperatingPoint&);

}  // namespace dynalin

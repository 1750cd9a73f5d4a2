// Takes an operating point over into the system of an edited model: by class and id of the elements, never by index.
// What is new starts as the dataset draws it.
#pragma once

#include "model/restated.h"
#include "system/system.h"

namespace dynalin {

OperatingPoint carried_over(const System& from, const OperatingPoint&, const System& to, const Restated& = {});

}  // namespace dynalin

// What MOTIONs of velocity and acceleration integrate, where nothing else has to be integrated: functions of time
// alone, by quadrature to rounding.
#pragma once

#include "system/system.h"

namespace dynalin {

// Takes the courses from the point `from` to the instant `to.time`.
void advance_courses(const System&, const OperatingPoint& from, OperatingPoint& to);

}  // namespace dynalin

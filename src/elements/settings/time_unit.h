// Units of time in seconds.
#pragma once

#include <string_view>

namespace dynalin {

// Of a keyword of UNITS/TIME, and of MKS and its like; 1 where no unit is stated.
double seconds_in(std::string_view unit_of_time);

}  // namespace dynalin

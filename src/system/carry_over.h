// Takes an operating point over into the system of an edited model: by class and id of the elements, never by index.
// What is new starts as the dataset draws it.
#pragma once

#include <set>
#include <string>
#include <utility>

#include "system/system.h"

namespace dynalin {

// What was stated anew about the start.
struct Restated {
  std::set<std::pair<std::string, std::int64_t>> starts;  // "PART", 3: bodies and states that begin where it is stated
  bool velocities = false;                                // and velocities of bodies count as stated
};

OperatingPoint carried_over(const System& from, const OperatingPoint&, const System& to, const Restated& = {});

}  // namespace dynalin

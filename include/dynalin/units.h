// The units of a dataset, as far as it states them.
#pragma once

#include <string>

namespace dynalin {

// Force · ucf = mass · acceleration. A dataset is calculated in its own units, which are consistent but for this
// factor.
struct Units {
  bool stated = false;
  double ucf = 1;
  double length_in_metres = 1;
  // Keywords of the language, "NEWTON"; empty where the dataset states the factor alone, or SYSTEM=NONE.
  std::string force, mass, length, time;

  // "s", "ms", "min" …; "time" where the unit of time is not known.
  std::string time_symbol() const;
  // Of eigenvalues and frequencies everywhere: "cycles/s" and the like, "cycles/time" where it is not known.
  std::string frequency() const { return "cycles/" + time_symbol(); }

  friend bool operator==(const Units&, const Units&) = default;
};

}  // namespace dynalin

// Limits of steps and times as settings state them.
#pragma once

#include <optional>

namespace dynalin {

// A limit of zero is none that was stated.
inline double stated_limit(const std::optional<double>& value, double otherwise) {
  return value && *value > 0 ? *value : otherwise;
}

}  // namespace dynalin

// Eigenvalues are in radians inside and in cycles where people see them.
#pragma once

#include <numbers>

namespace dynalin {

inline constexpr double cycle = 2 * std::numbers::pi;  // radians

}  // namespace dynalin

#pragma once

#include <numbers>

namespace dynalin {

inline constexpr double degree = std::numbers::pi / 180;  // [rad]

}  // namespace dynalin

// A MARKER at an instant: its origin, its axes, and how they move; along the global axes.
#pragma once

#include <array>

#include "dynalin/operating_state.h"

namespace dynalin {

struct MarkerState {
  Triple position{};              // [length]
  std::array<Triple, 3> axes{};   // its x, y and z axis
  Triple velocity{};              // [length/time]
  Triple angular_velocity{};      // [rad/time]
  Triple acceleration{};          // [length/time²]
  Triple angular_acceleration{};  // [rad/time²]
};

}  // namespace dynalin

// What two bodies that only touch each other conserve.
#pragma once

#include <fmt/format.h>

#include <string>

namespace dynalin::in_time {

// VARIABLE/1 to 3, momentum, and VARIABLE/4 to 6, moment of momentum about the origin, of a body with its mass centre
// in MARKER/2, mass 2 and the moment of inertia 0.3 about every axis, and one in MARKER/5, with 3 and 0.5.
inline std::string momenta_of_two_bodies() {
  std::string text;
  const std::string axes = "XYZ";
  for (std::size_t k = 0; k < 3; ++k) {
    const char x = axes[k], y = axes[(k + 1) % 3], z = axes[(k + 2) % 3];
    text += fmt::format("VARIABLE/{0}, FUNCTION=2*V{1}(2)+3*V{1}(5)\n", k + 1, x);
    text += fmt::format(
        "VARIABLE/{0}, FUNCTION=2*(D{2}(2)*V{3}(2)-D{3}(2)*V{2}(2))+3*(D{2}(5)*V{3}(5)-D{3}(5)*V{2}(5))"
        "+0.3*W{1}(2)+0.5*W{1}(5)\n",
        k + 4, x, y, z);
  }
  return text;
}

}  // namespace dynalin::in_time

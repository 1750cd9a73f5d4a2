// A spring with its damper between two points, in two halves that may move apart: each is rigid on its side.
#pragma once

#include <array>
#include <cstddef>

#include "geometry/mesh.h"

namespace dynalin {

struct SpringDamperSize {
  double coils = 0, diameter = 0;        // of the spring; none where either is 0
  std::array<double, 2> cup_diameter{};  // of the damper's tubes at either end; none where it or the length is 0
  std::array<double, 2> cup_length{};
  std::array<double, 2> tip_length{};  // straight pieces between the ends and all of that
  std::size_t segments = 20;           // of a coil and around a tube
};

// Along z from the origin to `distance` > 0. The first half reaches from the origin to the middle of the spring, the
// second one from there to the end; the tubes reach as far as they are long. A coil is a band of parallelograms, a
// quarter of its pitch wide; the spring lies between the tips, or all the way where the distance is less than both.
std::array<Mesh, 2> spring_damper_halves(const SpringDamperSize&, double distance);

}  // namespace dynalin

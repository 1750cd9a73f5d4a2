// Points of Gauss along an element of a beam: those of its strains, and those of the line that carries mass and loads.
#pragma once

#include <array>

#include "small_algebra.h"

namespace dynalin::oracle {

inline constexpr std::size_t strain_points = 3, line_points = 4;

// Where they are in 0..1, with weights that sum to 1, from their closed forms.
struct GaussPoint {
  Real at, weight;
};
[[nodiscard]] inline std::array<GaussPoint, strain_points> three_points() {
  const Real a = std::sqrt(0.6L) / 2;
  return {{{0.5L - a, 5 / 18.0L}, {0.5L, 8 / 18.0L}, {0.5L + a, 5 / 18.0L}}};
}
[[nodiscard]] inline std::array<GaussPoint, line_points> four_points() {
  const Real root = 2 * std::sqrt(1.2L) / 7, near = std::sqrt(3 / 7.0L - root) / 2,
             far = std::sqrt(3 / 7.0L + root) / 2;
  const Real heavy = (18 + std::sqrt(30.0L)) / 72, light = (18 - std::sqrt(30.0L)) / 72;
  return {{{0.5L - far, light}, {0.5L - near, heavy}, {0.5L + near, heavy}, {0.5L + far, light}}};
}

}  // namespace dynalin::oracle

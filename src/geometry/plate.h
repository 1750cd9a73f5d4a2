// Plates with round corners, and links, which are plates of two corners.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace dynalin {

// The outline at the distance `radius` ≥ 0 from a polygon in the plane z = 0, counter-clockwise: arcs about its
// corners, of `segments` straight pieces for a full turn, and sharp where it is concave. Two corners make a slot.
// Nothing where the polygon has no area (two corners: no radius), or where a side beside a concave corner is too short
// for the radius.
std::optional<std::vector<Vector>> rounded_outline(std::span<const Vector> corners, double radius,
                                                   std::size_t segments);

}  // namespace dynalin

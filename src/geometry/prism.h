// What an outline sweeps along a direction: boxes, plates, extrusions.
#pragma once

#include <span>

#include "geometry/mesh.h"

namespace dynalin {

// The outline of a closed prism does not say its first point again. Where it has no area across the direction or
// crosses itself, and for an open outline, the result is a sheet. Sides along the direction sweep nothing.
enum class Outline { open, closed };
Mesh prism(std::span<const Vector> outline, Outline, const Vector& along);

// From the origin along x, y and z, extents of either sign.
Mesh box(const Vector& extent);

}  // namespace dynalin

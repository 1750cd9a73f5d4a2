// Lines: arcs, circles and polylines.
#pragma once

#include <span>

#include "geometry/mesh.h"
#include "geometry/revolution.h"

namespace dynalin {

// About z in the plane z = 0; a full turn is a circle.
Mesh arc(double radius, const Sweep&);
// Through points one after the other; those that are the point before them are left out. Empty where no line is left.
Mesh polyline(std::span<const Vector> points);

}  // namespace dynalin

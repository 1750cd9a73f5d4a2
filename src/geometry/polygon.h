// Faces of polygons with any number of corners.
#pragma once

#include <span>

#include "geometry/mesh.h"

namespace dynalin {

// The vector area of a polygon, the better half of its corners' plane where they are in none. [length²]
Vector vector_area(std::span<const Vector> corners);

// Adds a polygon through vertices of the mesh: as one quadrilateral where it is a convex one, else as triangles. It may
// be concave and have corners on straight sides. False, and nothing is added, where its outline has no area or crosses
// itself, or where it has so many thousands of corners and dents that filling it would take seconds.
bool add_polygon(Mesh&, std::span<const Mesh::Index> corners);

}  // namespace dynalin

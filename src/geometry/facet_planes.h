// Which facets are of one plane but for roundings, and their vertices put into it. A file in single precision leaves
// angles of 1e-6 and more between facets of one plane; across such an edge, or above it, a linear model would hold for
// less than a millionth of the size.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "geometry/mesh.h"

namespace dynalin {

struct FacetOfPlane {
  std::array<Mesh::Index, 3> corner;
  std::array<Mesh::Index, 3> across;  // the facet beyond each side
  Vector normal;
};

// Two facets or more, or one that is along an axis but for roundings.
struct FacetPlane {
  std::vector<Mesh::Index> facets, vertices;
  Vector normal;
  double height = 0;  // along the normal, from the origin
};

// Facets that are connected and whose normals differ from that of the first one by 3e-5 at most. Components of a normal
// below 1e-6 are left out.
std::vector<FacetPlane> facet_planes(std::span<const Vector> vertices, double size, std::size_t facets,
                                     const std::function<FacetOfPlane(std::size_t)>&);
// Moves vertices by no more than a millionth of the size, each into all of its planes.
void put_into_planes(std::span<Vector> vertices, double size, std::span<const FacetPlane>);

}  // namespace dynalin

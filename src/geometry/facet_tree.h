// The tree of boxes in which triangles of a body of facets are looked for: Eigen's.
#pragma once

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "geometry/facet_body.h"

namespace dynalin {

using BoundingBox = Eigen::AlignedBox3d;
inline Eigen::Vector3d to_eigen(const Vector& v) { return {v.x, v.y, v.z}; }

struct FacetBody::Tree {
  std::vector<int> items;
  std::vector<BoundingBox> boxes;
  Eigen::KdBVH<double, 3, int> hierarchy;
};

}  // namespace dynalin

#include "geometry/facet_planes.h"

#include <gtest/gtest.h>

namespace dynalin::facet_planes_test {

namespace {

// Three planes that meet at right angles in `corner`, turned so that nothing is along an axis.
struct Corner {
  Vector corner{3, -2, 5};
  Matrix3 axes = rotation_exponential(Vector{0.4, -0.9, 1.3});

  FacetPlane plane(std::size_t k, std::vector<Mesh::Index> vertices) const {
    return {{}, std::move(vertices), axes[k], dot(axes[k], corner)};
  }
};

}  // namespace

TEST(facet_planes, take_a_vertex_into_all_of_its_planes_and_no_farther) {
  const Corner at;
  const Vector off{2e-7, -3e-7, 1e-7};
  // A vertex of three planes, one of two, one of one and one of none.
  std::vector<Vector> vertices(4, at.corner + at.axes * off);
  const std::vector<FacetPlane> planes = {at.plane(0, {0, 1, 2}), at.plane(1, {0, 1}), at.plane(2, {0})};
  put_into_planes(vertices, 1, planes);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const Vector now = transpose(at.axes) * (vertices[v] - at.corner);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(now[k], k + v < 3 ? 0.0 : off[k], 1e-15) << v << k;
  }
}

TEST(facet_planes, leave_a_vertex_that_is_farther_off_than_a_millionth_of_the_size) {
  const Corner at;
  std::vector<Vector> vertices(1, at.corner + at.axes * Vector{2e-6, 0, 0});
  const std::vector<Vector> before = vertices;
  const std::vector<FacetPlane> planes = {at.plane(0, {0})};
  put_into_planes(vertices, 1, planes);
  EXPECT_EQ(norm(vertices[0] - before[0]), 0);
  put_into_planes(vertices, 3, planes);
  EXPECT_NEAR(dot(at.axes[0], vertices[0] - at.corner), 0, 1e-15);
}

}  // namespace dynalin::facet_planes_test

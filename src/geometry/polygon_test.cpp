#include "geometry/polygon.h"

#include <algorithm>
#include <random>

#include "geometry/mesh_test_support.h"

namespace dynalin::polygon_test {
namespace {

struct Filled {
  Mesh mesh;
  bool added;
};
Filled filled(const std::vector<Vector>& corners) {
  Filled f;
  std::vector<Mesh::Index> all;
  for (const Vector& p : corners) all.push_back(f.mesh.add(p));
  f.added = add_polygon(f.mesh, all);
  return f;
}
double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) area += norm(vector_area(corners_of(mesh, t)));
  for (const auto& q : mesh.quads) area += norm(vector_area(corners_of(mesh, q)));
  return area;
}

TEST(Polygon, with_four_convex_corners_is_one_quadrilateral) {
  const Filled f = filled({{0, 0, 1}, {2, 0, 1}, {2, 1, 2}, {0, 1, 2}});
  EXPECT_TRUE(f.added);
  EXPECT_EQ(f.mesh.quads.size(), 1u);
  expect_sound(f.mesh);
}

TEST(Polygon, with_a_dent_is_two_triangles_beside_it) {
  for (std::size_t turned = 0; turned < 4; ++turned) {
    std::vector<Vector> corners{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(turned), corners.end());
    const Filled f = filled(corners);
    EXPECT_TRUE(f.added);
    EXPECT_EQ(f.mesh.triangles.size(), 2u);
    expect_sound(f.mesh);
    EXPECT_NEAR(area_of(f.mesh), 4, 1e-12);
  }
}

TEST(Polygon, with_corners_on_its_sides_has_no_flat_triangle) {
  const Filled f = filled({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 2, 0}, {0, 1, 0}});
  EXPECT_TRUE(f.added);
  expect_sound(f.mesh);
  EXPECT_NEAR(area_of(f.mesh), 4.5, 1e-12);
}

TEST(Polygon, far_from_its_origin_is_as_good_as_near) {
  for (const double far : {0.0, 1e7}) {
    const Filled f = filled({{far, 0, 0}, {far + 1, 0, 0}, {far + 0.25, 0.25, 0}, {far, 1, 0}});
    EXPECT_TRUE(f.added);
    EXPECT_EQ(f.mesh.triangles.size(), 2u);
  }
}

TEST(Polygon, without_area_or_with_crossing_sides_is_none) {
  EXPECT_FALSE(filled({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}).added);
  EXPECT_FALSE(filled({{0, 0, 0}, {1, 0, 0}}).added);
  EXPECT_FALSE(filled({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).added);
  const Filled crossing = filled({{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 3, 0}, {-1, 1, 0}});
  EXPECT_FALSE(crossing.added);
  EXPECT_EQ(crossing.mesh.faces(), 0u);
}

// Stars about a point, in a plane of any direction.
TEST(Polygon, of_any_shape_is_covered_once) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> reach(0.2, 1.0), any(-1, 1);
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix3 R = rotation_exponential({3 * any(random), 3 * any(random), 3 * any(random)});
    std::vector<Vector> corners;
    const int n = 5 + trial % 20;
    for (int k = 0; k < n; ++k) {
      const double angle = 6.283185307179586 * k / n, r = reach(random);
      corners.push_back(R * Vector{r * std::cos(angle), r * std::sin(angle), 0.7});
    }
    const Filled f = filled(corners);
    ASSERT_TRUE(f.added);
    expect_sound(f.mesh);
    EXPECT_EQ(f.mesh.triangles.size(), static_cast<std::size_t>(n - 2));
    EXPECT_NEAR(area_of(f.mesh), norm(vector_area(corners)), 1e-12);
    for (const auto& t : f.mesh.triangles) EXPECT_GT(dot(vector_area(corners_of(f.mesh, t)), R.z), 0);
  }
}

}  // namespace
}  // namespace dynalin::polygon_test

#include "geometry/convex_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/facet_body.h"
#include "geometry/prism.h"
#include "geometry/revolution.h"

namespace dynalin::convex_body_test {
namespace {

// Each face in its plane with everything below it, each edge between its two faces, each face after a neighbour.
void expect_sound(const ConvexBody& body) {
  const double close = 1e-12 * body.size();
  for (std::size_t k = 0; k < body.faces().size(); ++k) {
    const ConvexBody::Face& f = body.faces()[k];
    EXPECT_NEAR(norm(f.normal), 1, 1e-14);
    for (const Vector& c : body.corners()) EXPECT_LE(dot(f.normal, c), f.height + close);
    const std::size_t n = f.corners.size();
    ASSERT_EQ(f.across.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      const Vector& a = body.corners()[f.corners[i]];
      EXPECT_NEAR(dot(f.normal, a), f.height, close);
      const Vector side = body.corners()[f.corners[(i + 1) % n]] - a,
                   next = body.corners()[f.corners[(i + 2) % n]] - body.corners()[f.corners[(i + 1) % n]];
      EXPECT_GT(dot(cross(side, next), f.normal), 0);
    }
    if (k > 0) {
      EXPECT_LT(f.before, k);
      EXPECT_EQ(std::ranges::count(f.across, f.before), 1);
    }
  }
  for (const ConvexBody::Edge& e : body.edges()) {
    for (const auto face : {e.left, e.right}) {
      const ConvexBody::Face& f = body.faces()[face];
      for (const auto c : {e.from, e.to}) {
        EXPECT_NEAR(dot(f.normal, body.corners()[c]), f.height, close);
        EXPECT_EQ(std::ranges::count(f.corners, c), 1);
        EXPECT_EQ(std::ranges::count(body.faces_at(c), face), 1);
      }
      const Vector into = face == e.left ? e.into_left : e.into_right;
      EXPECT_NEAR(dot(into, f.normal), 0, 1e-14);
      EXPECT_NEAR(dot(into, e.along), 0, 1e-14);
      for (const auto c : f.corners) EXPECT_GE(dot(into, body.corners()[c] - body.corners()[e.from]), -close);
    }
    EXPECT_NEAR(norm(body.corners()[e.to] - body.corners()[e.from] - e.length * e.along), 0, close);
  }
}
void expect_counts(const ConvexBody* body, std::size_t corners, std::size_t edges, std::size_t faces) {
  ASSERT_TRUE(body);
  expect_sound(*body);
  EXPECT_EQ(body->corners().size(), corners);
  EXPECT_EQ(body->edges().size(), edges);
  EXPECT_EQ(body->faces().size(), faces);
}

TEST(ConvexBody, box_has_its_faces_edges_and_corners) {
  const ConvexBody box = ConvexBody::box({-1, -2, 0.5}, {1, 3, 2});
  expect_counts(&box, 8, 12, 6);
  EXPECT_DOUBLE_EQ(box.size(), norm(Vector{2, 5, 1.5}));
}

TEST(ConvexBody, facets_of_one_plane_are_one_face) {
  expect_counts(FacetBody(box({2, 3, 1})).convex(), 8, 12, 6);
  expect_counts(FacetBody(cylinder(1, 2, {})).convex(), 40, 60, 22);
  expect_counts(FacetBody(cylinder(1, 2, {.angle = 2, .segments = 10})).convex(), 24, 36, 14);
  expect_counts(FacetBody(frustum(1, 0, 2, {.segments = 8})).convex(), 9, 16, 9);
  // Halves of a plate that are one: an extra corner on two of its sides.
  const std::vector<Vector> outline{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}};
  expect_counts(FacetBody(prism(outline, Outline::closed, {0, 0, 1})).convex(), 8, 12, 6);
}

TEST(ConvexBody, what_is_hollow_has_none) {
  const std::vector<Vector> angle{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  EXPECT_FALSE(FacetBody(prism(angle, Outline::closed, {0, 0, 1})).convex());
  EXPECT_FALSE(FacetBody(torus(2, 0.5, {})).convex());
  EXPECT_FALSE(FacetBody(cylinder(1, 2, {.angle = 4})).convex());
  Mesh two = box({1, 1, 1}), other = box({1, 1, 1});
  for (Vector& v : other.vertices) v.x += 3;
  append(two, other);
  EXPECT_FALSE(FacetBody(two).convex());
}

// In single precision, and turned so that nothing is along an axis.
TEST(ConvexBody, what_is_hollow_by_roundings_alone_is_convex) {
  Mesh egg = ellipsoid({1, 0.7, 1.4}, 300);
  const Matrix3 R = rotation_exponential({0.3, 1.1, 0.7});
  for (Vector& v : egg.vertices) {
    v = R * v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = static_cast<float>(v[k]);
  }
  const FacetBody facets(egg);
  const ConvexBody* body = facets.convex();
  ASSERT_TRUE(body);
  for (const ConvexBody::Face& f : body->faces()) {
    const Vector farthest = body->corners()[body->farthest(f.normal, f.corners[0])];
    EXPECT_LE(dot(f.normal, farthest), f.height + 1e-6);
  }
  // A dent is none.
  Mesh dented = ellipsoid({1, 0.7, 1.4}, 30);
  dented.vertices[40] = dented.vertices[40] * 0.999;
  EXPECT_FALSE(FacetBody(dented).convex());
}

TEST(ConvexBody, finds_the_farthest_corner_from_any_other) {
  const FacetBody facets(ellipsoid({1, 0.7, 1.4}, 24));
  const ConvexBody* body = facets.convex();
  ASSERT_TRUE(body);
  expect_sound(*body);
  std::mt19937_64 random(2);
  std::normal_distribution<double> any;
  for (int draw = 0; draw < 500; ++draw) {
    const Vector direction{any(random), any(random), any(random)};
    double most = -1e300;
    for (const Vector& c : body->corners()) most = std::max(most, dot(direction, c));
    const auto start = static_cast<ConvexBody::Index>(random() % body->corners().size());
    EXPECT_EQ(dot(direction, body->corners()[body->farthest(direction, start)]), most);
  }
}

}  // namespace
}  // namespace dynalin::convex_body_test

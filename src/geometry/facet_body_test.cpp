#include "geometry/facet_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "geometry/facet_touch.h"
#include "geometry/prism.h"

namespace dynalin::facet_body_test {
namespace {

using Kind = FacetBody::Feature::Kind;

// An octahedron, its triangles halved along all sides `times` times and its vertices moved to random radii.
Mesh boulder(int times, double roughness) {
  Mesh m;
  for (const Vector& v : {Vector{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) m.add(v);
  for (const Mesh::Index top : {4u, 5u}) {
    const std::array<Mesh::Index, 4> belt{0, 2, 1, 3};
    for (std::size_t k = 0; k < 4; ++k) {
      if (top == 4)
        m.triangles.push_back({belt[k], belt[(k + 1) % 4], top});
      else
        m.triangles.push_back({belt[(k + 1) % 4], belt[k], top});
    }
  }
  for (; times > 0; --times) {
    std::map<std::pair<Mesh::Index, Mesh::Index>, Mesh::Index> middle;
    const auto between = [&](Mesh::Index a, Mesh::Index b) {
      const auto [it, made] = middle.try_emplace(std::minmax(a, b), 0);
      if (made) {
        const Vector sum = m.vertices[a] + m.vertices[b];
        it->second = m.add(sum / norm(sum));
      }
      return it->second;
    };
    std::vector<std::array<Mesh::Index, 3>> finer;
    for (const auto& [a, b, c] : m.triangles) {
      const auto ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    m.triangles = finer;
  }
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(1 - roughness, 1);
  for (Vector& v : m.vertices) v = v * share(random);
  close(m);
  return m;
}

// The angle that the surface is seen under: 4π from inside, 0 from outside.
double seen_from(const Mesh& m, const Vector& p) {
  double sum = 0;
  for (const auto& t : m.triangles) {
    const Vector a = m.vertices[t[0]] - p, b = m.vertices[t[1]] - p, c = m.vertices[t[2]] - p;
    const double down = norm(a) * norm(b) * norm(c) + dot(a, b) * norm(c) + dot(b, c) * norm(a) + dot(c, a) * norm(b);
    sum += 2 * std::atan2(dot(a, cross(b, c)), down);
  }
  return sum;
}

// By points all over the surface: never less, and more by no more than they are apart.
double sampled_distance(const Mesh& m, const Vector& p, int n) {
  double least = 1e300;
  for (const auto& t : m.triangles) {
    for (int i = 0; i <= n; ++i) {
      for (int k = 0; k <= n - i; ++k) {
        const double a = static_cast<double>(i) / n, b = static_cast<double>(k) / n;
        least = std::min(least, norm(m.vertices[t[0]] * a + m.vertices[t[1]] * b + m.vertices[t[2]] * (1 - a - b) - p));
      }
    }
  }
  return least;
}

// The corner that stands inwards is at z, its walls x = 0 and y = 0 where the other coordinate is positive.
Mesh angle_iron() {
  const std::vector<Vector> outline{{0, 0, -1}, {0, 1, -1}, {-1, 1, -1}, {-1, -1, -1}, {1, -1, -1}, {1, 0, -1}};
  return prism(outline, Outline::closed, {0, 0, 2});
}

}  // namespace

TEST(facet_body, has_the_nearest_place_and_its_side) {
  const Mesh mesh = boulder(2, 0.3);
  const FacetBody body(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-1.3, 1.3);
  int inside = 0, outside = 0;
  for (int k = 0; k < 200; ++k) {
    const Vector p{at(random), at(random), at(random)};
    const auto place = body.nearest(p);
    const double sampled = sampled_distance(mesh, p, 24);
    EXPECT_LE(place.distance, sampled + 1e-12);
    EXPECT_GE(place.distance, sampled - 0.02);
    EXPECT_NEAR(norm(p - place.point), place.distance, 1e-12);
    const bool is_inside = seen_from(mesh, p) > 2 * std::numbers::pi;
    EXPECT_EQ(place.outside, !is_inside);
    ++(is_inside ? inside : outside);
    EXPECT_TRUE(place.definite);
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(outside, 20);
}

// A box, whose faces are halved by diagonals, has none there and in the middle of its edges.
TEST(facet_body, knows_faces_edges_and_corners_however_they_are_divided) {
  Mesh mesh = box({2, 2, 2});
  // A vertex in the middle of the upper face, and one in the middle of the edge along x at y = 0, z = 2.
  const auto index_of = [&](const Vector& p) {
    for (Mesh::Index v = 0; v < mesh.vertices.size(); ++v) {
      if (norm(mesh.vertices[v] - p) < 1e-12) return v;
    }
    throw std::logic_error("no such vertex");
  };
  const auto centre = mesh.add({1, 1, 2}), half = mesh.add({1, 0, 2});
  std::vector<std::array<Mesh::Index, 4>> kept;
  for (const auto& q : mesh.quads) {
    const bool upper = std::ranges::all_of(q, [&](auto v) { return mesh.vertices[v].z == 2; });
    const bool front = std::ranges::all_of(q, [&](auto v) { return mesh.vertices[v].y == 0; });
    if (!upper && !front) kept.push_back(q);
  }
  mesh.quads = kept;
  const auto a = index_of({0, 0, 2}), b = index_of({2, 0, 2}), c = index_of({2, 2, 2}), d = index_of({0, 2, 2});
  const auto e = index_of({0, 0, 0}), f = index_of({2, 0, 0});
  mesh.triangles = {{a, half, centre}, {half, b, centre}, {b, c, centre}, {c, d, centre},
                    {d, a, centre},    {e, f, half},      {e, half, a},   {f, b, half}};
  mesh.closed = false;
  close(mesh);
  ASSERT_TRUE(mesh.closed);
  const FacetBody body(mesh);
  EXPECT_EQ(body.corners().size(), 8u);
  const auto above = body.nearest({1, 1, 2.5});
  EXPECT_EQ(above.feature.kind, Kind::face);
  EXPECT_NEAR(norm(above.feature.direction - Vector{0, 0, 1}), 0, 1e-15);
  const auto beside = body.nearest({1, -0.3, 2.4});
  EXPECT_EQ(beside.feature.kind, Kind::edge);
  EXPECT_DOUBLE_EQ(std::abs(beside.feature.direction.x), 1);
  EXPECT_NEAR(beside.distance, 0.5, 1e-15);
  EXPECT_EQ(body.nearest({0.7, -0.3, 2.4}).feature.kind, Kind::edge);
  EXPECT_EQ(body.nearest({0.6, 0.4, 2.1}).feature.kind, Kind::face);
  EXPECT_EQ(body.nearest({-0.1, -0.1, 2.2}).feature.kind, Kind::vertex);
  EXPECT_FALSE(body.nearest({1, 1, 1}).definite);
  EXPECT_FALSE(body.nearest({1, 1, 1}).outside);
}

// As a file in single precision holds an inclined plane: vertices and edges in its middle are places of a face.
TEST(facet_body, has_faces_where_facets_are_of_one_plane_but_for_roundings) {
  constexpr int n = 20;
  Mesh mesh;
  const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  const auto top = [&](int i, int k) {
    const double x = 0.2 * i - 2, y = 0.2 * k - 2;
    return Vector{single(x), single(y), single(0.3 * x + 0.07 * y)};
  };
  for (const bool upper : {true, false}) {
    for (int i = 0; i <= n; ++i) {
      for (int k = 0; k <= n; ++k) mesh.add(upper ? top(i, k) : top(i, k) - Vector{0, 0, 2});
    }
  }
  const auto at = [](bool upper, int i, int k) {
    return static_cast<Mesh::Index>((upper ? 0 : (n + 1) * (n + 1)) + i * (n + 1) + k);
  };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      mesh.triangles.push_back({at(true, i, k), at(true, i + 1, k), at(true, i + 1, k + 1)});
      mesh.triangles.push_back({at(true, i, k), at(true, i + 1, k + 1), at(true, i, k + 1)});
      mesh.quads.push_back({at(false, i, k), at(false, i, k + 1), at(false, i + 1, k + 1), at(false, i + 1, k)});
    }
    mesh.quads.push_back({at(false, i, 0), at(false, i + 1, 0), at(true, i + 1, 0), at(true, i, 0)});
    mesh.quads.push_back({at(false, i + 1, n), at(false, i, n), at(true, i, n), at(true, i + 1, n)});
    mesh.quads.push_back({at(false, 0, i + 1), at(false, 0, i), at(true, 0, i), at(true, 0, i + 1)});
    mesh.quads.push_back({at(false, n, i), at(false, n, i + 1), at(true, n, i + 1), at(true, n, i)});
  }
  close(mesh);
  ASSERT_TRUE(mesh.closed);
  const FacetBody body(mesh);
  EXPECT_EQ(body.corners().size(), 8u);
  const Vector normal = Vector{-0.3, -0.07, 1} / norm(Vector{-0.3, -0.07, 1});
  std::vector<FacetBody::Place> places;
  for (const auto& [i, k] : {std::pair{10, 10}, {7, 12}, {13, 4}}) {
    for (const Vector& aside : {Vector{}, {0.1, 0, 0.03}, {0.1, 0.1, 0.037}, {0.05, 0.05, 0.0185}}) {
      const Vector p = top(i, k) + aside + normal * 0.095;
      body.critical_places(p, 0.1, false, places);
      ASSERT_EQ(places.size(), 1u);
      EXPECT_EQ(places[0].feature.kind, Kind::face);
      EXPECT_NEAR(places[0].distance, 0.095, 1e-6);
      EXPECT_LT(norm(places[0].feature.direction - normal), 1e-5);
      EXPECT_EQ(body.nearest(p).feature.kind, Kind::face);
      EXPECT_TRUE(body.nearest(p).definite);
    }
  }
}

// What stands inwards is no corner, and neither is the tip of a pit.
TEST(facet_body, has_corners_where_it_stands_out) {
  EXPECT_EQ(FacetBody(angle_iron()).corners().size(), 10u);
  EXPECT_EQ(FacetBody(boulder(3, 0)).corners().size(), 258u);
  Mesh pit = boulder(0, 0);
  pit.vertices[4] = {0, 0, -0.5};
  EXPECT_EQ(FacetBody(pit).corners().size(), 5u);
}

TEST(facet_body, has_critical_places_of_the_distance) {
  const FacetBody body(angle_iron());
  std::vector<FacetBody::Place> places;
  const auto sum = [&] {
    double all = 0;
    for (const auto& p : places) all += p.weight;
    return all;
  };
  // In the corner: both walls, whose common edge is out of the ball.
  body.critical_places({0.45, 0.48, 0.1}, 0.5, false, places);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_NEAR(norm(places[0].point - Vector{0, 0.48, 0.1}), 0, 1e-15);
  EXPECT_NEAR(norm(places[1].point - Vector{0.45, 0, 0.1}), 0, 1e-15);
  EXPECT_EQ(sum(), 2);
  // Deeper, the edge between them too.
  body.critical_places({0.3, 0.3, 0.1}, 0.5, false, places);
  ASSERT_EQ(places.size(), 3u);
  EXPECT_EQ(places[2].weight, -1);
  EXPECT_NEAR(places[2].distance, std::hypot(0.3, 0.3), 1e-15);
  EXPECT_EQ(sum(), 1);
  // On the outer edge.
  body.critical_places({-1.3, 1.4, 0.1}, 0.55, false, places);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_NEAR(places[0].distance, 0.5, 1e-15);
  // In the same body as a cavity the corner stands out.
  body.critical_places({-0.3, -0.3, 0.1}, 0.5, true, places);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].weight, 1);
  EXPECT_NEAR(places[0].distance, std::hypot(0.3, 0.3), 1e-15);
  EXPECT_FALSE(places[0].outside);
  const Vec3<double> centre{-0.3, -0.3, 0.1};
  const auto from = solid::distance(places[0], centre);
  EXPECT_NEAR(from.value, -std::hypot(0.3, 0.3), 1e-15);
  EXPECT_NEAR(norm(from.direction - Vector{std::sqrt(0.5), std::sqrt(0.5), 0}), 0, 1e-15);
  // The far side of a sheet, in the ball as well, looks away.
  const FacetBody sheet(box({2, 2, 0.01}));
  body.critical_places({5, 5, 5}, 0.5, false, places);
  EXPECT_TRUE(places.empty());
  // Near its edge as well: the diagonal of the face, right below, is none.
  for (const Vector& p : {Vector{1, 1, 0.3}, {1.9, 0.7, 0.3}}) {
    sheet.critical_places(p, 0.4, false, places);
    ASSERT_EQ(places.size(), 1u);
    EXPECT_NEAR(places[0].distance, 0.29, 1e-15);
  }
}

// A ball that dips into a hilly surface anywhere, whichever hills and valleys are in it: what is summed up goes on
// smoothly, and so does its derivative.
TEST(facet_body, sums_of_the_distance_over_critical_places_are_smooth) {
  const FacetBody body(boulder(3, 0.06));
  constexpr double radius = 0.5;
  const auto potential = [&](const Vector& p) {
    std::vector<FacetBody::Place> places;
    body.critical_places(p, radius, false, places);
    double sum = 0;
    for (const auto& q : places) sum += q.weight * std::pow(radius - q.distance, 2);
    return sum;
  };
  const auto force = [&](const Vector& p) {
    std::vector<FacetBody::Place> places;
    body.critical_places(p, radius, false, places);
    Vector sum{};
    for (const auto& q : places) sum += (p - q.point) * (2 * q.weight * (radius - q.distance) / q.distance);
    return sum;
  };
  std::mt19937 random(9);
  std::normal_distribution<double> n;
  int several = 0;
  for (int k = 0; k < 60; ++k) {
    const Vector out{n(random), n(random), n(random)}, way{n(random), n(random), n(random)};
    const Vector from = out * (1.36 / norm(out)), along = way * (0.3 / norm(way));
    constexpr int steps = 3000;
    const auto at = [&](int i) { return from + along * (static_cast<double>(i) / steps); };
    Vector before = force(at(0));
    for (int i = 1; i <= steps; ++i) {
      const Vector here = force(at(i));
      // Of places with curvatures of at most 1/0.1 in a ball whose force is at most 2·0.4: no jumps.
      ASSERT_LT(norm(here - before), 60 * norm(along) / steps) << k << ' ' << i;
      before = here;
      if (i % 100 != 0) continue;
      std::vector<FacetBody::Place> places;
      body.critical_places(at(i), radius, false, places);
      several += places.size() > 2;
      constexpr double h = 1e-6;
      for (std::size_t c = 0; c < 3; ++c) {
        const double slope =
            (potential(at(i) + h * unit_vectors[c]) - potential(at(i) - h * unit_vectors[c])) / (2 * h);
        EXPECT_NEAR(here[c], -slope, 1e-4);
      }
    }
  }
  EXPECT_GT(several, 50);
}

}  // namespace dynalin::facet_body_test

// Convex bodies of facets: boxes as boxes in closed form, on planes, exchanged, and their derivatives.
#include "geometry/convex_touch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/convex_parting.h"
#include "geometry/prism.h"
#include "geometry/revolution.h"
#include "geometry/seen_back.h"

namespace dynalin::convex_touch_test {
namespace {

using namespace solid;
using Seeded = Dual<12>;
using Frame3 = RelativeFrame<double>;

Polyhedron facets_of(Mesh mesh, const Vector& move = {}) {
  for (Vector& v : mesh.vertices) v += move;
  return {std::make_shared<const FacetBody>(mesh)};
}
Polyhedron facets_of(const Box& b) { return facets_of(dynalin::box(b.high - b.low), b.low); }

RelativeFrame<Seeded> seeded(const Frame3& f) {
  const auto along = [](const Vector& v) { return Vec3<Taylor>{Taylor(v.x), Taylor(v.y), Taylor(v.z)}; };
  const auto s = path::seeded<12>({along(f.p), along(f.x), along(f.y), along(f.z)});
  const auto values = [](const auto& v) { return Vec3<Seeded>{v.x.value, v.y.value, v.z.value}; };
  return {values(s.p), values(s.x), values(s.y), values(s.z)};
}

// What a pressure of 1 per length makes of all places: force and torque about J's origin.
template <class T>
struct Resultant {
  Vec3<T> force{T(0.0), T(0.0), T(0.0)}, torque{T(0.0), T(0.0), T(0.0)};
  double deepest = 0;
  int places = 0;
  bool defined = true;
};
template <class T>
Resultant<T> resultant(const Side& I, const RelativeFrame<T>& f, const Side& J) {
  std::vector<Touch<T>> list(touch_count(I, J));
  EXPECT_FALSE(list.empty());
  find_touches<T>(I, J, f, list);
  Resultant<T> sum;
  for (const Touch<T>& t : list) {
    if (!t.closed()) continue;
    const Vec3<T> F = t.normal * (-t.gap * t.weight);
    sum.force += F, sum.torque += cross(t.point, F);
    sum.deepest = std::max(sum.deepest, -value_of(t.gap));
    sum.defined = sum.defined && t.defined;
    ++sum.places;
  }
  return sum;
}

class convex_touch : public ::testing::Test {
 protected:
  double any() { return normal_(random_); }
  Frame3 pose(double far) {
    const Matrix3 R = rotation_exponential({any(), any(), any()});
    return {{far * any(), far * any(), far * any()}, R.x, R.y, R.z};
  }
  static void expect_same(const Vec3<Seeded>& a, const Vec3<Seeded>& b, double tolerance) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(a[k].value, b[k].value, tolerance);
      for (std::size_t n = 0; n < 12; ++n) EXPECT_NEAR(a[k].partial[n], b[k].partial[n], 100 * tolerance);
    }
  }
  static void expect_same(const Resultant<Seeded>& a, const Resultant<Seeded>& b, double tolerance = 1e-11) {
    EXPECT_EQ(a.defined, b.defined);
    EXPECT_NEAR(a.deepest, b.deepest, tolerance);
    expect_same(a.force, b.force, tolerance);
    expect_same(a.torque, b.torque, tolerance);
  }

  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};

const Box brick{{-0.35, -0.4, -0.3}, {0.35, 0.4, 0.3}}, slab{{-1, -0.8, -0.1}, {0.9, 1.1, 0.1}};

Frame3 back(const Frame3& f) { return seen_back(f); }

}  // namespace

// Whatever the pose: corners, crossings of edges, and those that share.
TEST_F(convex_touch, of_facets_of_boxes_is_that_of_boxes) {
  int touching = 0, of_edges = 0;
  for (int draw = 0; draw < 600; ++draw) {
    const Box& other = draw % 2 ? brick : slab;
    const Frame3 f = pose(0.35);
    const auto wanted = resultant(Side{brick}, seeded(f), Side{other});
    SCOPED_TRACE(draw);
    expect_same(resultant(Side{facets_of(brick)}, seeded(f), Side{facets_of(other)}), wanted);
    expect_same(resultant(Side{brick}, seeded(f), Side{facets_of(other)}), wanted);
    expect_same(resultant(Side{facets_of(brick)}, seeded(f), Side{other}), wanted);
    touching += wanted.places > 0, of_edges += wanted.places > 1;
  }
  EXPECT_GT(touching, 400);
  EXPECT_GT(of_edges, 100);
}

// Standing flat on each other, flush on some sides and askew: where places share.
TEST_F(convex_touch, of_stacks_of_facets_is_that_of_boxes) {
  for (const double angle : {0.0, 0.2, 0.7853981633974483, 1.5707963267948966}) {
    for (const double tilt : {0.0, 1e-9, 3e-3, 0.02}) {
      for (const double off : {0.0, 0.1, 0.7, 0.95}) {
        const Matrix3 R = rotation_exponential({tilt, 0.5 * tilt, 0}) * rotation_exponential({0, 0, angle});
        const Frame3 f{{off, 0.3 * off, 0.39}, R.x, R.y, R.z};
        SCOPED_TRACE(::testing::Message() << angle << ' ' << tilt << ' ' << off);
        const auto wanted = resultant(Side{brick}, seeded(f), Side{slab});
        EXPECT_GT(wanted.places, 0);
        expect_same(resultant(Side{facets_of(brick)}, seeded(f), Side{facets_of(slab)}), wanted, 1e-10);
        const Frame3 g = {{0.02 * off, 0, 0.59}, R.x, R.y, R.z};
        expect_same(resultant(Side{facets_of(brick)}, seeded(g), Side{brick}),
                    resultant(Side{brick}, seeded(g), Side{brick}), 1e-10);
      }
    }
  }
}

// A drum and an egg on a plate that is larger than they: as on a plane, with as many corners.
TEST_F(convex_touch, on_a_plate_is_on_a_plane) {
  const Side plate{facets_of(dynalin::box({20, 20, 3}), {-10, -10, -3})}, plane{Plane{-10, 10, -10, 10}};
  const std::array<Side, 3> bodies{Side{facets_of(cylinder(0.5, 1, {.segments = 30}))},
                                   Side{facets_of(dynalin::ellipsoid({0.5, 0.7, 0.4}, 40))},
                                   Side{facets_of(frustum(0.5, 0, 1, {.segments = 7}))}};
  int many = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Side& body = bodies[static_cast<std::size_t>(draw % 3)];
    Frame3 f = pose(0.5);
    if (draw % 9 == 0) f.x = {1, 0, 0}, f.y = {0, -1, 0}, f.z = {0, 0, -1};
    double low = 1e300;
    for (const Vector& c : std::get<Polyhedron>(body.shape).body->corners())
      low = std::min(low, f.x.z * c.x + f.y.z * c.y + f.z.z * c.z);
    f.p.z = -low - 0.01;
    const auto wanted = resultant(body, seeded(f), plane), found = resultant(body, seeded(f), plate);
    SCOPED_TRACE(draw);
    EXPECT_EQ(found.places, wanted.places);
    EXPECT_NEAR(found.deepest, 0.01, 1e-12);
    expect_same(found, wanted);
    many += found.places > 3;
  }
  EXPECT_GT(many, 50);
}

// By all faces and all pairs of edges.
TEST_F(convex_touch, parts_bodies_in_the_direction_in_which_they_overlap_least) {
  const Polyhedron egg = facets_of(dynalin::ellipsoid({0.5, 0.7, 0.4}, 10)), drum = facets_of(cylinder(0.4, 0.9, {}));
  const ConvexBody &I = *egg.body->convex(), &J = *drum.body->convex();
  int of_I = 0, of_J = 0, of_edges = 0, apart = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Frame3 f = pose(0.45);
    double least = 1e300;
    const auto look = [&](Vector n) {
      if (!(norm(n) > 1e-9)) return;
      n = n / norm(n);
      for (const Vector& direction : {n, -n}) {
        double of_J_most = -1e300, of_I_least = 1e300;
        for (const Vector& c : J.corners()) of_J_most = std::max(of_J_most, dot(direction, c));
        for (const Vector& c : I.corners())
          of_I_least = std::min(of_I_least, dot(direction, f.p + f.x * c.x + f.y * c.y + f.z * c.z));
        least = std::min(least, of_J_most - of_I_least);
      }
    };
    const auto turned = [&](const Vector& v) { return f.x * v.x + f.y * v.y + f.z * v.z; };
    for (const auto& face : J.faces()) look(face.normal);
    for (const auto& face : I.faces()) look(turned(face.normal));
    for (const auto& e : I.edges())
      for (const auto& g : J.edges()) look(cross(turned(e.along), g.along));
    const ConvexParting part = convex_parting(I, f, J);
    // Faces are preferred by a millionth, and where the bodies are far apart edges are not looked at.
    if (least > 0)
      EXPECT_NEAR(part.overlap, least, 2e-6) << draw;
    else
      EXPECT_LE(part.overlap, 0) << draw;
    if (least <= 0)
      ++apart;
    else
      ++(part.face_of_I ? of_I : part.face_of_J ? of_J : of_edges);
  }
  EXPECT_GT(std::min({of_I, of_J, of_edges, apart}), 10);
}

TEST_F(convex_touch, exchanged_bodies_push_each_other_with_opposite_forces) {
  const Side egg{facets_of(dynalin::ellipsoid({0.5, 0.7, 0.4}, 12))},
      drum{facets_of(cylinder(0.4, 0.9, {.segments = 9}))};
  int touching = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Frame3 f = pose(0.45);
    const auto one = resultant(egg, f, drum), other = resultant(drum, back(f), egg);
    const auto turned = [&](const Vector& v) { return f.x * v.x + f.y * v.y + f.z * v.z; };
    const Vector F = turned(other.force), M = turned(other.torque) + cross(f.p, F);
    EXPECT_LT(norm(one.force + F), 1e-12) << draw;
    EXPECT_LT(norm(one.torque + M), 1e-12) << draw;
    EXPECT_EQ(one.places, other.places);
    touching += one.places > 0;
  }
  EXPECT_GT(touching, 150);
}

// A body that is nowhere in the other one has no place, one that is has the deepest of all.
TEST_F(convex_touch, deepest_place_is_as_deep_as_the_bodies_overlap) {
  const Side egg{facets_of(dynalin::ellipsoid({0.5, 0.7, 0.4}, 12))},
      drum{facets_of(cylinder(0.4, 0.9, {.segments = 9}))};
  const ConvexBody &I = *std::get<Polyhedron>(egg.shape).body->convex(),
                   &J = *std::get<Polyhedron>(drum.shape).body->convex();
  int touching = 0;
  for (int draw = 0; draw < 500; ++draw) {
    const Frame3 f = pose(0.45);
    const double overlap = convex_parting(I, f, J).overlap;
    const auto sum = resultant(egg, f, drum);
    EXPECT_EQ(sum.places > 0, overlap > 0) << draw;
    if (overlap <= 0) continue;
    ++touching;
    EXPECT_NEAR(sum.deepest, overlap, 3e-6) << draw;
    EXPECT_TRUE(sum.defined);
  }
  EXPECT_GT(touching, 200);
}

// Differences of force and torque, between which no place comes or goes.
TEST_F(convex_touch, duals_are_the_derivatives) {
  const std::array<Side, 3> bodies{Side{facets_of(dynalin::ellipsoid({0.5, 0.7, 0.4}, 12))},
                                   Side{facets_of(cylinder(0.4, 0.9, {.segments = 9}))},
                                   Side{facets_of(frustum(0.5, 0, 1, {.segments = 4}))}};
  int compared = 0, several = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Side &I = bodies[static_cast<std::size_t>(draw % 3)], &J = bodies[static_cast<std::size_t>(draw / 3 % 3)];
    const Frame3 f = pose(0.4);
    const Vector move{any(), any(), any()}, turn{any(), any(), any()};
    const auto at = [&](double t) {
      const Matrix3 R = rotation_exponential(t * turn);
      return Frame3{f.p + t * move, R * f.x, R * f.y, R * f.z};
    };
    RelativeFrame<Seeded> dual;
    const auto seed = [](const Vector& v, const Vector& rate) {
      Vec3<Seeded> s{Seeded(v.x), Seeded(v.y), Seeded(v.z)};
      for (std::size_t k = 0; k < 3; ++k) s[k].partial[0] = rate[k];
      return s;
    };
    dual.p = seed(f.p, move), dual.x = seed(f.x, cross(turn, f.x)), dual.y = seed(f.y, cross(turn, f.y));
    dual.z = seed(f.z, cross(turn, f.z));
    constexpr double h = 1e-6;
    const auto exact = resultant(I, dual, J);
    const auto before = resultant(I, at(-h), J), middle = resultant(I, f, J), after = resultant(I, at(h), J);
    if (exact.places == 0 || before.places != exact.places || after.places != exact.places) continue;
    if (norm(before.force + after.force - 2.0 * middle.force) > 1e-8) continue;  // another face
    ++compared, several += exact.places > 1;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(exact.force[k].value, middle.force[k], 1e-14);
      EXPECT_NEAR(exact.force[k].partial[0], (after.force[k] - before.force[k]) / (2 * h), 1e-5) << draw;
      EXPECT_NEAR(exact.torque[k].partial[0], (after.torque[k] - before.torque[k]) / (2 * h), 1e-5) << draw;
    }
  }
  EXPECT_GT(compared, 150);
  EXPECT_GT(several, 40);
}

// A drum that leaves over the edge of a slab, corner by corner.
TEST_F(convex_touch, goes_on_smoothly_where_a_corner_leaves_over_an_edge) {
  const Side prism{facets_of(cylinder(0.5, 1, {.segments = 5}))}, table{facets_of(Box{{-2, -2, -1}, {2, 2, 0}})};
  constexpr double step = 1e-8;
  for (const double tilt : {0.0, 0.01}) {
    const Matrix3 R = rotation_exponential({0, tilt, 0}) * rotation_exponential({0, 0, 0.1});
    double reach = -1e300, at_height = 0;
    for (const Vector& c : std::get<Polyhedron>(prism.shape).body->corners()) {
      const Vector p = R * c;
      if (c.z == 0 && p.x > reach) reach = p.x, at_height = p.z;
    }
    const auto at = [&](double off) {
      return resultant(prism, Frame3{{2 - reach + off, 0.3, -0.02 - at_height}, R.x, R.y, R.z}, table);
    };
    const auto before = at(-step), middle = at(0), after = at(step);
    EXPECT_GT(before.force.z, 0.05);
    EXPECT_LT(norm(before.force - after.force), 100 * step) << tilt;
    EXPECT_LT(norm(before.torque - after.torque), 100 * step) << tilt;
    EXPECT_LT(norm(middle.force - after.force), 100 * step) << tilt;
  }
}

// An edge of the one above the edge of the other, and corner on corner: other directions part as soon.
TEST_F(convex_touch, tells_where_directions_part_as_soon) {
  const Side top{facets_of(frustum(0.5, 0, 1, {.segments = 4}))};
  const auto sum = resultant(top, Frame3{{0, 0, 1.9}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, top);
  EXPECT_GT(sum.places, 0);
  EXPECT_FALSE(sum.defined);
}

}  // namespace dynalin::convex_touch_test

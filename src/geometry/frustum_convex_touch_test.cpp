// Cylinders and frusta with convex bodies of facets: boxes as boxes in closed form, others against a search over all
// directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "geometry/convex_parting.h"
#include "geometry/flat_test_support.h"
#include "geometry/frustum_touch.h"
#include "geometry/moved_frame_test_support.h"
#include "geometry/seen_back.h"

namespace dynalin::frustum_convex_touch_test {
namespace {

using namespace flat_test;
using Stand = RelativeFrame<double>;
using solid::Box;
using solid::Frustum;
using solid::Side;
using Seeded = Dual<12>;

const std::array<Frustum, 6> rounds{{{-0.4, 0.25, 0.5, 0.25},
                                     {-0.3, 0.4, 0.6, 0},
                                     {-0.2, 0.35, 0.4, 0.15},
                                     {-0.05, 0.5, 0.05, 0.5},
                                     {-1, 0.06, 1, 0.06},
                                     {-0.5, 0, 0.2, 0.3}}};

template <class T>
std::vector<Touch<T>> touches(const Side& I, const RelativeFrame<T>& f, const Side& J) {
  std::vector<Touch<T>> list(touch_count(I, J));
  EXPECT_FALSE(list.empty());
  find_touches<T>(I, J, f, list);
  return list;
}

// What a pressure of 1 per length makes of all places.
template <class T>
struct Resultant {
  Vec3<T> force{T(0.0), T(0.0), T(0.0)}, torque{T(0.0), T(0.0), T(0.0)};
  double deepest = 0;
  int places = 0;
  bool defined = true;
};
template <class T>
Resultant<T> resultant(const Side& I, const RelativeFrame<T>& f, const Side& J) {
  Resultant<T> sum;
  for (const Touch<T>& t : touches(I, f, J)) {
    if (!t.closed()) continue;
    const Vec3<T> F = t.normal * (-t.gap * t.weight);
    sum.force += F, sum.torque += cross(t.point, F);
    sum.deepest = std::max(sum.deepest, -value_of(t.gap));
    sum.defined = sum.defined && t.defined;
    ++sum.places;
  }
  return sum;
}

double reach(const Frustum& f, const Stand& at, const Vector& n) {
  const double across = std::hypot(dot(at.x, n), dot(at.y, n)), along = dot(at.z, n);
  return std::max(f.low * along + f.low_radius * across, f.high * along + f.high_radius * across);
}
// How far a place is outside of one, at least.
double beyond(const Frustum& f, const Vector& p) {
  const double slope = (f.high_radius - f.low_radius) / (f.high - f.low);
  return std::max({std::hypot(p.x, p.y) - (f.low_radius + slope * (p.z - f.low)), p.z - f.high, f.low - p.z});
}
double beyond(const std::vector<Vector>& normals, const Side& J, const Vector& p) {
  double most = -1e300;
  for (const Vector& n : normals) most = std::max(most, dot(n, p) - reach_of(J, n));
  return most;
}

class FrustumConvex : public ::testing::Test {
 protected:
  double any() { return normal_(random_); }
  Stand pose(double far) {
    const Matrix3 R = rotation_exponential({any(), any(), any()});
    return {{far * any(), far * any(), far * any()}, R.x, R.y, R.z};
  }
  static void expect_same(const Vec3<Seeded>& a, const Vec3<Seeded>& b, double tolerance) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(a[k].value, b[k].value, tolerance);
      for (std::size_t n = 0; n < 12; ++n)
        EXPECT_NEAR(a[k].partial[n], b[k].partial[n], 1e3 * tolerance * (1 + std::abs(b[k].partial[n])));
    }
  }
  static void expect_same(const Resultant<Seeded>& a, const Resultant<Seeded>& b, double tolerance = 1e-10) {
    EXPECT_EQ(a.defined, b.defined);
    EXPECT_EQ(a.places, b.places);
    EXPECT_NEAR(a.deepest, b.deepest, tolerance);
    expect_same(a.force, b.force, tolerance);
    expect_same(a.torque, b.torque, tolerance);
  }

  // A force that nowhere jumps as something rolls.
  template <class Force>
  static void expect_steady(const Force& force) {
    constexpr double step = 5e-4;
    Vector last = force(0.01);
    for (double tilt = 0.01 + step; tilt < 0.4; tilt += step) {
      const Vector here = force(tilt);
      EXPECT_LT(norm(here - last), 2 * step) << tilt;
      last = here;
    }
  }

  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};

const Box brick{{-0.5, -0.4, -0.3}, {0.6, 0.5, 0.4}}, plate{{-0.8, -0.8, -0.05}, {0.8, 0.8, 0.05}},
    bar{{-0.08, -0.1, -1}, {0.07, 0.1, 1}};

}  // namespace

TEST_F(FrustumConvex, of_facets_of_a_box_is_that_of_the_box) {
  const std::array<Box, 3> boxes{brick, plate, bar};
  int touching = 0, several = 0;
  for (int draw = 0; draw < 600; ++draw) {
    const Side I{rounds[static_cast<std::size_t>(draw) % rounds.size()]};
    const Box& box = boxes[static_cast<std::size_t>(draw / 6) % 3];
    const Stand f = pose(0.5);
    const auto wanted = resultant(I, seeded(f), Side{box});
    SCOPED_TRACE(draw);
    expect_same(resultant(I, seeded(f), Side{facets_of(box)}), wanted);
    touching += wanted.places > 0, several += wanted.places > 1;
  }
  EXPECT_GT(touching, 250);
  EXPECT_GT(several, 60);
}

// Lying, standing and leaning on it, in its middle and over its edges.
TEST_F(FrustumConvex, rests_on_facets_of_a_box_as_on_the_box) {
  const Box table{{-1, -0.8, -0.4}, {0.9, 1.1, 0}};
  int resting = 0;
  for (const Frustum& round : rounds) {
    const Side I{round};
    for (const double lean : {0.0, 1e-9, 3e-5, 2e-3, 0.3, 1.2, 1.5707963267948966}) {
      for (const double turn : {0.0, 0.3, 0.7853981633974483}) {
        for (const double off : {0.0, 0.5, 0.85, 0.97}) {
          const Matrix3 R = rotation_exponential({0, 0, turn}) * rotation_exponential({0, lean, 0});
          Stand f{{off, 0.4 * off, 0}, R.x, R.y, R.z};
          f.p.z = reach(round, f, {0, 0, -1}) - 0.004;
          SCOPED_TRACE(::testing::Message() << lean << ' ' << turn << ' ' << off << ' ' << round.low_radius);
          const auto wanted = resultant(I, seeded(f), Side{table});
          resting += wanted.places > 0;
          expect_same(resultant(I, seeded(f), Side{facets_of(table)}), wanted);
          expect_same(resultant(I, seeded(f), Side{divided_box(table)}), wanted);
        }
      }
    }
  }
  EXPECT_GT(resting, 400);
}

// One place at least is as deep as the bodies are from parting; all are on both surfaces.
TEST_F(FrustumConvex, one_place_is_as_deep_as_they_are_from_parting) {
  const std::vector<Side> bodies = flat_bodies();
  int apart = 0, together = 0, refused = 0;
  std::vector<std::vector<Vector>> normals;
  for (const Side& J : bodies) normals.push_back(sharp_directions(J));
  for (int draw = 0; draw < 600; ++draw) {
    const std::size_t of_J = static_cast<std::size_t>(draw) % bodies.size();
    const Side& J = bodies[of_J];
    const Frustum& round = rounds[static_cast<std::size_t>(draw / 6) % rounds.size()];
    const Stand f = pose(0.45);
    const auto separation = [&](const Vector& n) { return dot(n, f.p) - reach(round, f, -n) - reach_of(J, n); };
    std::vector<Vector> sharp = normals[of_J];
    sharp.push_back(f.z), sharp.push_back(-f.z);
    double h = largest_separation(separation, sharp);
    double deepest = 0, nearest = 1;
    bool defined = true;
    SCOPED_TRACE(draw);
    const auto places = touches(Side{round}, f, J);
    // Where the search has stuck on a ridge.
    for (const Touch<double>& t : places)
      if (t.closed()) h = std::max(h, separation(t.normal));
    for (const Touch<double>& t : places) {
      if (!t.closed()) continue;
      defined = defined && t.defined;
      deepest = std::max(deepest, -t.gap), nearest = std::min(nearest, std::abs(h - t.gap));
      EXPECT_NEAR(norm(t.normal), 1, 1e-12);
      const Vector on_I = t.point + 0.5 * t.gap * t.normal, on_J = t.point - 0.5 * t.gap * t.normal, arm = on_I - f.p;
      EXPECT_NEAR(beyond(round, {dot(f.x, arm), dot(f.y, arm), dot(f.z, arm)}), 0, 1e-9);
      if (!normals[of_J].empty()) {
        EXPECT_NEAR(beyond(normals[of_J], J, on_J), 0, 1e-9);
      }
    }
    ++(h > 0 ? apart : together);
    refused += !defined;
    if (h > 0) {
      EXPECT_EQ(deepest, 0);
    } else if (defined) {
      EXPECT_LE(nearest, 1e-9);
      EXPECT_LE(deepest, h > -0.02 ? -1.1 * h + 1e-9 : 2.0);
    }
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(together, 200);
  EXPECT_EQ(refused, 0);
}

TEST_F(FrustumConvex, exchanged_sides_push_each_other_with_opposite_forces) {
  const std::vector<Side> bodies = flat_bodies();
  int touching = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const Side &J = bodies[static_cast<std::size_t>(draw) % bodies.size()],
               I{rounds[static_cast<std::size_t>(draw / 6) % rounds.size()]};
    const Stand f = pose(0.45);
    const auto one = resultant(I, f, J), other = resultant(J, seen_back(f), I);
    const auto turned = [&](const Vector& v) { return f.x * v.x + f.y * v.y + f.z * v.z; };
    const Vector F = turned(other.force), M = turned(other.torque) + cross(f.p, F);
    EXPECT_LT(norm(one.force + F), 1e-12) << draw;
    EXPECT_LT(norm(one.torque + M), 1e-12) << draw;
    EXPECT_EQ(one.places, other.places);
    touching += one.places > 0;
  }
  EXPECT_GT(touching, 80);
}

// Differences of force and torque, between which no place comes or goes.
TEST_F(FrustumConvex, duals_are_the_derivatives) {
  const std::vector<Side> bodies = flat_bodies();
  constexpr double h = 1e-6;
  int compared = 0, several = 0;
  for (int draw = 0; draw < 400; ++draw) {
    const Side &J = bodies[static_cast<std::size_t>(draw) % bodies.size()],
               I{rounds[static_cast<std::size_t>(draw / 6) % rounds.size()]};
    const Stand f = pose(0.45);
    const auto middle = resultant(I, f, J);
    if (middle.places == 0 || !middle.defined) continue;
    const Vector move{any(), any(), any()}, turn{any(), any(), any()};
    RelativeFrame<Seeded> dual;
    const auto seed = [](const Vector& v, const Vector& rate) {
      Vec3<Seeded> s{Seeded(v.x), Seeded(v.y), Seeded(v.z)};
      for (std::size_t k = 0; k < 3; ++k) s[k].partial[0] = rate[k];
      return s;
    };
    dual.p = seed(f.p, move), dual.x = seed(f.x, cross(turn, f.x)), dual.y = seed(f.y, cross(turn, f.y));
    dual.z = seed(f.z, cross(turn, f.z));
    const auto at = [&](double t) {
      const Matrix3 R = rotation_exponential(t * turn);
      return resultant(I, Stand{f.p + t * move, R * f.x, R * f.y, R * f.z}, J);
    };
    const auto before = at(-h), after = at(h);
    if (before.places != middle.places || after.places != middle.places) continue;
    if (norm(before.force + after.force - 2.0 * middle.force) > 1e-7) continue;  // another face
    const auto exact = resultant(I, dual, J);
    ++compared, several += middle.places > 1;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(exact.force[k].value, middle.force[k], 1e-14);
      const double of_force = (after.force[k] - before.force[k]) / (2 * h),
                   of_torque = (after.torque[k] - before.torque[k]) / (2 * h);
      EXPECT_NEAR(exact.force[k].partial[0], of_force, 1e-4 * (1 + std::abs(of_force))) << draw;
      EXPECT_NEAR(exact.torque[k].partial[0], of_torque, 1e-4 * (1 + std::abs(of_torque))) << draw;
    }
  }
  EXPECT_GT(compared, 150);
  EXPECT_GT(several, 40);
}

// A plate with five corners on the end of a post: as a corner leaves over the rim, its edges have what that had.
TEST_F(FrustumConvex, goes_on_smoothly_where_corners_leave_over_a_rim) {
  constexpr double step = 1e-8;
  const Frustum post{-1, 0.5, 0, 0.5};
  for (const int corners : {3, 4, 5, 8}) {
    const Side lid{facets_of(dynalin::cylinder(0.2, 0.1, {.segments = static_cast<std::size_t>(corners)}))};
    for (const double angle : {0.0, 0.2}) {
      const Matrix3 R = rotation_exponential({0, 0, angle});
      const Vector at = R * Vector{0.2, 0, 0};  // one of its corners
      // Along x, until it is over the rim.
      const double there = std::sqrt(0.25 - at.y * at.y) - at.x;
      const auto where = [&](double off) {
        return resultant(lid, Stand{{there + off, 0, -0.004}, R.x, R.y, R.z}, Side{post});
      };
      const auto before = where(-step), after = where(step);
      SCOPED_TRACE(::testing::Message() << corners << ' ' << angle);
      EXPECT_NEAR(before.force.z, 0.004 * corners, 1e-9);
      EXPECT_LT(norm(before.force - after.force), 1e3 * step);
      EXPECT_LT(norm(before.torque - after.torque), 1e3 * step);
    }
  }
}

// A disc on a dome: whatever its turn, all corners that are below it press, and as it rolls from facet to facet none
// comes or goes at once.
TEST_F(FrustumConvex, stands_on_all_corners_of_a_dome) {
  const Side dome{facets_of(dynalin::ellipsoid({1, 1, 1}, 24))}, disc{Frustum{0, 0.6, 0.1, 0.6}};
  const auto at = [&](double tilt, double depth) {
    const Matrix3 R = rotation_exponential({0.3 * tilt, tilt, 0});
    return resultant(disc, Stand{(1 - depth) * R.z, R.x, R.y, R.z}, dome);
  };
  const double ring = 1 - std::cos(std::numbers::pi / 12);
  const auto level = at(0, ring + 0.001);
  EXPECT_EQ(level.places, 25);
  EXPECT_NEAR(level.force.z, ring + 25 * 0.001, 1e-9);
  EXPECT_LT(std::hypot(level.force.x, level.force.y), 1e-9);
  EXPECT_LT(norm(level.torque), 1e-9);
  expect_steady([&](double tilt) { return at(tilt, 0.04).force; });
}

// As deep along a whole circle of directions but for one: a disc on the end of a drum, all about one axis.
TEST_F(FrustumConvex, stands_on_what_has_the_same_axis) {
  const Side drum{facets_of(dynalin::cylinder(0.8, 1.2, {.segments = 40}))}, disc{Frustum{0, 0.4, 0.04, 0.4}};
  for (const double depth : {1e-4, 0.01, 0.03}) {
    const auto sum = resultant(disc, Stand{{0, 0, 1.2 - depth}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, drum);
    EXPECT_TRUE(sum.defined);
    EXPECT_EQ(sum.places, 1);
    EXPECT_NEAR(sum.force.z, depth, 1e-4);
    EXPECT_LT(norm(sum.torque), 1e-12);
  }
}

// A rod along an arch of strips: on all edges that are below it.
TEST_F(FrustumConvex, lies_on_all_edges_of_an_arch) {
  const Side arch{facets_of(dynalin::cylinder(2, 1, {.segments = 60}), {0, 0, -0.5})}, rod{Frustum{-1, 0.1, 1, 0.1}};
  const auto at = [&](double tilt, double depth) {  // about the axis of the arch
    const Vector out{std::cos(tilt), std::sin(tilt), 0}, along{-std::sin(tilt), std::cos(tilt), 0};
    return resultant(rod, Stand{(2.1 - depth) * out, cross(out, along), out, along}, arch);
  };
  const double lower = 2 * (1 - std::cos(std::numbers::pi / 30));
  EXPECT_EQ(at(0, 0.5 * lower).places, 1);
  const auto deep = at(0, lower + 0.001);
  EXPECT_EQ(deep.places, 3);
  EXPECT_NEAR(deep.force.x, lower + 3 * 0.001, 1e-9);
  expect_steady([&](double tilt) { return at(tilt, 0.04).force; });
}

TEST_F(FrustumConvex, is_the_same_in_other_units) {
  for (int draw = 0; draw < 100; ++draw) {
    const Stand f = pose(0.4);
    const Frustum& a = rounds[static_cast<std::size_t>(draw) % rounds.size()];
    const auto in = [&](double unit) {
      const Side I{Frustum{unit * a.low, unit * a.low_radius, unit * a.high, unit * a.high_radius}},
          J{facets_of(dynalin::ellipsoid({unit * 0.5, unit * 0.7, unit * 0.4}, 10))};
      return resultant(I, Stand{unit * f.p, f.x, f.y, f.z}, J);
    };
    const auto one = in(1), other = in(1000);
    EXPECT_EQ(one.places, other.places) << draw;
    EXPECT_LT(norm(one.force - other.force / 1000.0), 1e-9) << draw;
  }
}

// A tip below the axis of a cylinder, and on it, where it is as deep all around.
TEST_F(FrustumConvex, tells_where_directions_part_as_soon) {
  const Side spike{facets_of(dynalin::frustum(0.5, 0, 3, {.segments = 4}), {0, 0, -3})};
  const auto sum =
      resultant(Side{Frustum{-2, 0.1, 2, 0.1}}, Stand{{0, 0, 0.05}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, spike);
  EXPECT_GT(sum.places, 0);
  EXPECT_TRUE(sum.defined);
  const auto on_axis =
      resultant(Side{Frustum{-2, 0.1, 2, 0.1}}, Stand{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, spike);
  EXPECT_FALSE(on_axis.defined);
}

}  // namespace dynalin::frustum_convex_touch_test

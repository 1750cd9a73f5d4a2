// Ellipsoids and convex bodies of facets: boxes as boxes in closed form, others against a search over all directions.
#include "geometry/convex_ellipsoid_touch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "geometry/convex_parting.h"
#include "geometry/flat_test_support.h"
#include "geometry/moved_frame_test_support.h"
#include "geometry/revolution.h"
#include "geometry/seen_back.h"

namespace dynalin::convex_ellipsoid_touch_test {
namespace {

using namespace flat_test;
using Stand = RelativeFrame<double>;
using solid::Box;
using solid::Ellipsoid;
using solid::Side;
using Seeded = Dual<12>;

template <class T>
Touch<T> touched(const Side& I, const RelativeFrame<T>& at, const Side& J) {
  std::array<Touch<T>, 1> list;
  EXPECT_EQ(touch_count(I, J), 1u);
  find_touches<T>(I, J, at, list);
  return list[0];
}
double reach(const Vector& axes, const Stand& at, const Vector& n) {
  return norm(Vector{axes.x * dot(at.x, n), axes.y * dot(at.y, n), axes.z * dot(at.z, n)});
}

class ConvexEllipsoid : public ::testing::Test {
 protected:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  // As round as an egg, or as thin as a coin or a needle.
  Vector axes() {
    Vector a{between(0.3, 0.8), between(0.3, 0.8), between(0.3, 0.8)};
    if (between(0, 1) < 0.5) a[std::uniform_int_distribution<std::size_t>(0, 2)(random_)] = between(0.07, 0.18);
    if (between(0, 1) < 0.2) a[std::uniform_int_distribution<std::size_t>(0, 2)(random_)] = between(0.07, 0.18);
    return a;
  }
  Stand pose(double far) {
    const Matrix3 R = rotation_exponential({between(-3, 3), between(-3, 3), between(-3, 3)});
    return {{between(-far, far), between(-far, far), between(-far, far)}, R.x, R.y, R.z};
  }
  static void expect_same(const Touch<Seeded>& a, const Touch<Seeded>& b) {
    EXPECT_EQ(a.defined, b.defined);
    if (!a.defined || !b.defined) return;
    const auto same = [](const Seeded& x, const Seeded& y) {
      EXPECT_NEAR(x.value, y.value, 1e-10);
      for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(x.partial[k], y.partial[k], 1e-7 * (1 + std::abs(x.partial[k])));
    };
    same(a.gap, b.gap);
    for (std::size_t k = 0; k < 3; ++k) same(a.normal[k], b.normal[k]), same(a.point[k], b.point[k]);
  }

  std::mt19937_64 random_{17};
};

}  // namespace

TEST_F(ConvexEllipsoid, of_facets_of_a_box_is_that_of_the_box) {
  int together = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Box box{{-between(0.2, 0.6), -between(0.2, 0.6), -between(0.2, 0.6)},
                  {between(0.2, 0.6), between(0.2, 0.6), between(0.2, 0.6)}};
    const Side e{Ellipsoid{axes()}};
    const Stand f = pose(1);
    SCOPED_TRACE(draw);
    const auto wanted = touched(e, seeded(f), Side{box});
    const double least = std::min({std::get<Ellipsoid>(e.shape).semi_axes.x, std::get<Ellipsoid>(e.shape).semi_axes.y,
                                   std::get<Ellipsoid>(e.shape).semi_axes.z});
    if (!(wanted.gap.value > -0.5 * least)) continue;
    expect_same(touched(e, seeded(f), Side{facets_of(box)}), wanted);
    together += wanted.gap.value < 0;
  }
  EXPECT_GT(together, 30);
}

// The normal is the direction of the largest separation of all.
TEST_F(ConvexEllipsoid, is_along_the_direction_of_the_largest_separation) {
  int together = 0, deep = 0, refused = 0;
  const std::vector<Side> bodies = flat_bodies();
  for (int draw = 0; draw < 400; ++draw) {
    const Side& J = bodies[static_cast<std::size_t>(draw) % bodies.size()];
    const Vector a = axes();
    const double least_axis = std::min({a.x, a.y, a.z});
    const Stand f = pose(0.9);
    const auto separation = [&](const Vector& n) { return dot(n, f.p) - reach(a, f, n) - reach_of(J, n); };
    const double h = largest_separation(separation, sharp_directions(J));
    const Touch<double> t = touched(Side{Ellipsoid{a}}, f, J);
    if (h < -0.8 * least_axis) continue;
    SCOPED_TRACE(draw);
    together += h < 0, deep += h < -0.3 * least_axis;
    if (!t.defined) {
      EXPECT_LT(h, 0);
      ++refused;
      continue;
    }
    EXPECT_NEAR(separation(t.normal), t.gap, 1e-9);
    EXPECT_GE(t.gap, h - 1e-9);
  }
  EXPECT_GT(together, 80);
  EXPECT_GT(deep, 40);
  EXPECT_EQ(refused, 0);
}

TEST_F(ConvexEllipsoid, exchanged_sides_have_the_opposite_normal) {
  const std::vector<Side> bodies = flat_bodies();
  int together = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const Side &J = bodies[static_cast<std::size_t>(draw) % bodies.size()], I{Ellipsoid{axes()}};
    const Stand f = pose(0.9);
    const Touch<double> t = touched(I, f, J), back = touched(J, seen_back(f), I);
    const auto turned = [&](const Vector& v) { return f.x * v.x + f.y * v.y + f.z * v.z; };
    EXPECT_EQ(t.defined, back.defined);
    EXPECT_NEAR(t.gap, back.gap, 1e-14);
    EXPECT_LT(norm(t.normal + turned(back.normal)), 1e-14);
    EXPECT_LT(norm(t.point - f.p - turned(back.point)), 1e-14);
    together += t.gap < 0;
  }
  EXPECT_GT(together, 50);
}

TEST_F(ConvexEllipsoid, has_the_derivatives_of_differences) {
  constexpr double h = 1e-6;
  const std::vector<Side> bodies = flat_bodies();
  int compared = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Side& J = bodies[static_cast<std::size_t>(draw) % bodies.size()];
    const Vector a = axes();
    const Side I{Ellipsoid{a}};
    const Stand f = pose(0.9);
    const Touch<double> here = touched(I, f, J);
    if (!here.defined || here.gap > 0 || here.gap < -0.6 * std::min({a.x, a.y, a.z})) continue;
    const auto exact = touched(I, seeded(f), J);
    for (std::size_t c = 0; c < 6; ++c) {
      const auto after = touched(I, moved(f, c, h), J), before = touched(I, moved(f, c, -h), J);
      if (norm(after.point + before.point - 2.0 * here.point) > 1e-8) continue;  // another feature
      ++compared;
      const Vector turn = cross(here.point - f.p, here.normal);
      EXPECT_NEAR(exact.gap.partial[c], c < 3 ? here.normal[c] : turn[c - 3], 1e-8) << draw;
      for (std::size_t x = 0; x < 3; ++x) {
        const auto expect = [&](double from, double to, const Seeded& of) {
          EXPECT_NEAR((to - from) / (2 * h), of.partial[c], 1e-4 * (1 + std::abs(of.partial[c]))) << draw;
        };
        expect(before.normal[x], after.normal[x], exact.normal[x]);
        expect(before.point[x], after.point[x], exact.point[x]);
      }
    }
  }
  EXPECT_GT(compared, 300);
}

// Above the middle of a face, of an edge and of a corner, where all is symmetric; upright and lying.
TEST_F(ConvexEllipsoid, is_found_in_symmetric_poses) {
  const Side cube{facets_of(Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}})};
  const double s = std::sqrt(0.5), c = std::sqrt(1 / 3.0);
  for (const Vector& a : {Vector{0.3, 0.3, 0.1}, Vector{0.1, 0.1, 0.4}, Vector{0.2, 0.3, 0.4}}) {
    const Side e{Ellipsoid{a}};
    const auto gap = [&](const Vector& n, const Vector& x, const Vector& from, double away) {
      const Vector y = cross(n, x);
      const Touch<double> t = touched(e, Stand{from + away * n, x, y, n}, cube);
      EXPECT_TRUE(t.defined);
      EXPECT_LT(norm(t.normal - n), 1e-9);
      return t.gap;
    };
    for (const double away : {a.z - 0.02, a.z + 0.02}) {
      EXPECT_NEAR(gap({0, 0, 1}, {1, 0, 0}, {0, 0, 0.5}, away), away - a.z, 1e-12);
      EXPECT_NEAR(gap({0, 0, 1}, {1, 0, 0}, {0.5, 0.5, 0.5}, away), away - a.z, 1e-12);  // over a corner
      EXPECT_NEAR(gap({0, s, s}, {1, 0, 0}, {0.1, 0.5, 0.5}, away), away - a.z, 1e-12);
      EXPECT_NEAR(gap({c, c, c}, {s, -s, 0}, {0.5, 0.5, 0.5}, away), away - a.z, 1e-12);
    }
  }
}

// Facets of one plane, however it is divided, are one face.
TEST_F(ConvexEllipsoid, does_not_depend_on_how_faces_are_divided) {
  const Side cut{divided_box(Box{{-0.4, -0.5, -0.3}, {0.5, 0.4, 0.6}})},
      whole{facets_of(Box{{-0.4, -0.5, -0.3}, {0.5, 0.4, 0.6}})};
  for (int draw = 0; draw < 60; ++draw) {
    const Side e{Ellipsoid{axes()}};
    const Stand f = pose(0.9);
    SCOPED_TRACE(draw);
    expect_same(touched(e, seeded(f), cut), touched(e, seeded(f), whole));
  }
}

TEST_F(ConvexEllipsoid, is_the_same_in_other_units) {
  for (int draw = 0; draw < 100; ++draw) {
    const Vector a = axes();
    const Stand f = pose(0.8);
    const auto in = [&](double unit) {
      const Side J{facets_of(dynalin::ellipsoid({unit * 0.5, unit * 0.7, unit * 0.4}, 10))};
      return touched(Side{Ellipsoid{unit * a}}, Stand{unit * f.p, f.x, f.y, f.z}, J);
    };
    const Touch<double> one = in(1), other = in(1000);
    EXPECT_EQ(one.defined, other.defined);
    EXPECT_NEAR(one.gap, other.gap / 1000, 1e-12);
    if (one.defined) {
      EXPECT_LT(norm(one.normal - other.normal), 1e-8) << draw;
    }
  }
}

}  // namespace dynalin::convex_ellipsoid_touch_test

// Rings with bodies of facets that are not convex, and in cavities of facets: volumes in common.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/overlap_law.h"
#include "geometry/revolution.h"
#include "geometry/solid_overlap.h"
#include "geometry/torus_test_support.h"

namespace dynalin::torus_overlap_test {
namespace {

using namespace overlap_test;
using namespace torus_test;

// Volume and moment about the origin of the body, of all volumes.
template <class Overlaps>
std::array<double, 4> sums(const Overlaps& found) {
  std::array<double, 4> sum{};
  for (const auto& o : found.volumes) {
    const Vector moment = o.moment + o.origin * o.volume;
    sum[0] += o.volume;
    for (std::size_t c = 0; c < 3; ++c) sum[c + 1] += moment[c];
  }
  return sum;
}

class torus_overlap : public Poses {};

}  // namespace

// Sections along the axis and across it, whose areas are known: a half of the ring, and a slice of it from bottom to
// top, ∫ π ((R + q)² − (R − q)²) dz with q² = r² − z².
TEST_F(torus_overlap, has_the_volumes_of_slices) {
  for (const TorusSolid& s : {ring(), bun()}) {
    const double R = s.major(), r = s.minor();
    const auto integral = [&](double z) {
      return 2 * pi * R * (z * std::sqrt(r * r - z * z) + r * r * std::asin(z / r));
    };
    for (const double height : {-0.9, -0.3, 0.0, 0.2, 0.7, 0.99}) {
      const double y = height * r;
      const SolidOverlaps found = find_overlaps(s, at({0.2, -y, 0.1}, flat), floor_with_edge(), false);
      ASSERT_TRUE(found.definite);
      ASSERT_EQ(found.volumes.size(), 1u);
      const double wanted = integral(y) - integral(-r);
      EXPECT_NEAR(found.volumes[0].volume, wanted, 1e-11 * whole(s)) << height;
      const Vector centroid = found.volumes[0].origin + found.volumes[0].moment / found.volumes[0].volume;
      EXPECT_NEAR(centroid.x, 0.2, 1e-11);
      EXPECT_NEAR(centroid.z, 0.1, 1e-11);
      // ∫ 4 π R q z dz
      const double below = -4 * pi * R * std::pow(r * r - y * y, 1.5) / 3 / wanted;
      EXPECT_NEAR(centroid.y + y, below, 1e-11) << height;
    }
    // On edge: half of it, at the centroid of a half.
    const auto half = find_overlaps(s, at({0.2, 0, 0.1}), floor_with_edge(), false);
    ASSERT_EQ(half.volumes.size(), 1u);
    EXPECT_NEAR(half.volumes[0].volume, whole(s) / 2, 1e-12);
    const double wanted = -2 * (R * R + 0.25 * r * r) / (pi * R);
    EXPECT_NEAR(half.volumes[0].moment.y / half.volumes[0].volume, wanted, 1e-12);
  }
}

// Through a wall it goes twice: ∫ over the thickness of the section's area, on one side of the axis
// ∫ (√((R + q)² − x²) − √((R − q)² − x²)) dz with q² = r² − z².
TEST_F(torus_overlap, has_one_volume_for_each_time_that_it_goes_through_a_wall) {
  const TorusSolid s = ring();
  const double R = s.major(), r = s.minor();
  const FacetBody wall = swept({{-0.05, -2}, {2, -2}, {2, -1.5}, {0.05, -1.5}, {0.05, 2}, {-0.05, 2}}, -2, 2);
  const auto found = find_overlaps(s, at({0, 0, 0}), wall, false);
  ASSERT_TRUE(found.definite);
  ASSERT_EQ(found.volumes.size(), 2u);
  double wanted = 0;
  constexpr int many = 64;  // in the middle of even parts of turns, where all are periodic, and of the thickness
  for (int k = 0; k < many; ++k) {
    const double x = 0.05 * std::cos(pi * (k + 0.5) / many), share = std::sin(pi * (k + 0.5) / many);
    double area = 0;
    for (int n = 0; n < many; ++n) {
      const double q = r * std::sin(pi * (n + 0.5) / many);
      area += (std::sqrt((R + q) * (R + q) - x * x) - std::sqrt((R - q) * (R - q) - x * x)) * q * pi / many;
    }
    wanted += area * share * 0.05 * pi / many;
  }
  for (const SolidOverlap& o : found.volumes) {
    EXPECT_NEAR(o.volume, wanted, 1e-6);
    EXPECT_NEAR((o.origin + o.moment / o.volume).x, 0, 1e-13);
  }
  // A wall across half of the ring, along its axis: it is cut along its tube by both sides.
  const FacetBody thick = swept({{-2, -0.03}, {2, -0.03}, {2, 0.5}, {1.9, 0.5}, {1.9, 0.02}, {-2, 0.02}}, -2, 2);
  const auto layer = find_overlaps(s, at({0, 0, 0}, flat), thick, false);
  ASSERT_EQ(layer.volumes.size(), 1u);
  const auto integral = [&](double z) {
    return 2 * pi * R * (z * std::sqrt(r * r - z * z) + r * r * std::asin(z / r));
  };
  EXPECT_NEAR(layer.volumes[0].volume, integral(0.02) - integral(-0.03), 1e-13);
}

TEST_F(torus_overlap, is_what_it_comes_to_with_finely_drawn_rings) {
  const auto drawn = [](const TorusSolid& s, std::size_t count) {
    std::vector<Meridian> profile;
    for (std::size_t k = 0; k < count; ++k) {
      const double v = 2 * pi * static_cast<double>(k) / static_cast<double>(count);
      profile.push_back({s.major() + s.minor() * std::cos(v), s.minor() * std::sin(v)});
    }
    return FacetBody(revolved(profile, true, {.segments = 2 * count}));
  };
  const FacetBody a = angle(), b = star(5);
  for (const TorusSolid& s : {ring(), bun()}) {
    const FacetBody coarse = drawn(s, 16), fine = drawn(s, 32);
    int seen = 0, several = 0;
    for (int k = 0; k < 60; ++k) {
      const FacetBody& J = k % 2 == 0 ? a : b;
      const auto f = pose(0.35, {0.2, 0.2, 0});
      const SolidOverlaps exact = find_overlaps(s, f, J, false);
      ASSERT_TRUE(exact.definite) << k;
      const Overlaps one = find_overlaps(coarse, f, J, false), other = find_overlaps(fine, f, J, false);
      if (exact.engulfed || one.engulfed || other.engulfed) continue;
      const auto e = sums(exact), c = sums(one), d = sums(other);
      EXPECT_EQ(other.volumes.size(), exact.volumes.size()) << k;
      for (std::size_t n = 0; n < 4; ++n) {
        EXPECT_NEAR(c[n], e[n], 4e-2 * whole(s)) << k;
        // Extrapolated.
        EXPECT_NEAR((4 * d[n] - c[n]) / 3, e[n], 1e-3 * whole(s)) << k << ' ' << n;
      }
      double area = 0, area_of_facets = 0;
      for (const SolidOverlap& o : exact.volumes) area += o.curved.area;
      for (const Overlap& o : other.volumes) area_of_facets += overlap_law::surface_of(o.of_I);
      EXPECT_NEAR(area, area_of_facets, 1e-2 * 4 * pi * pi * s.major() * s.minor());
      seen += e[0] > 0, several += exact.volumes.size() > 1;
    }
    EXPECT_GT(seen, 30);
    EXPECT_GT(several, 2);
  }
}

// What is in a body and what is around it make up the ring, and nothing jumps.
TEST_F(torus_overlap, of_what_is_in_a_body_and_around_it_is_the_whole_ring) {
  const FacetBody a = angle(), b = star(5);
  int seen = 0;
  for (const TorusSolid& s : {ring(), bun()}) {
    for (int k = 0; k < 200; ++k) {
      const FacetBody& J = k % 2 == 0 ? a : b;
      auto f = pose(0.5, {0.2, 0.2, 0});
      const SolidOverlaps in = find_overlaps(s, f, J, false), around = find_overlaps(s, f, J, true);
      ASSERT_TRUE(in.definite && around.definite) << k;
      if (in.engulfed || around.engulfed || in.volumes.empty()) continue;
      const auto i = sums(in), o = sums(around);
      EXPECT_NEAR(i[0] + o[0], whole(s), 1e-11) << k;
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(i[c + 1] + o[c + 1], whole(s) * f.p[c], 1e-11) << k;
      f.p += Vector{1.3e-9, -0.7e-9, 0.9e-9};
      EXPECT_NEAR(sums(find_overlaps(s, f, J, false))[0], i[0], 1e-8);
      ++seen;
    }
  }
  EXPECT_GT(seen, 100);
}

TEST_F(torus_overlap, of_bodies_drawn_on_one_grid_is_definite) {
  const std::array<TorusSolid, 3> solids{TorusSolid({0.5, 0.125}), TorusSolid({0.375, 0.125}),
                                         TorusSolid({0.25, 0.1875})};
  expect_definite_on_one_grid(solids, 3000, 10, whole);
}

// As upright as that the planes of teeth touch the ring twice on its inner side, and the same on both sides of that:
// highest places of some lines are exactly above the joints of others.
TEST_F(torus_overlap, of_planes_that_touch_it_twice_is_the_whole_ring) {
  std::vector<std::array<double, 2>> outline{{-0.8, -1}, {0.8, -1}};
  constexpr int teeth = 7;
  for (int k = teeth; k > 0; --k) {
    const double high = -0.8 + 1.6 * k / teeth, low = high - 0.6 * 1.6 / teeth;
    outline.push_back({high, 0.8}), outline.push_back({low, 0.8});
    if (k > 1) outline.push_back({low, -0.9}), outline.push_back({-0.8 + 1.6 * (k - 1) / teeth, -0.9});
  }
  const FacetBody comb = swept(outline, -0.7, 0.7);
  int seen = 0;
  for (const TorusSolid& s : {TorusSolid({0.2, 0.19}), TorusSolid({0.3, 0.22}), ring()}) {
    const Matrix3 leans = rotation_exponential({std::asin(s.minor() / s.major()), 0, 0});
    for (int k = 0; k < 60; ++k) {
      const Matrix3 R = rotation_exponential({0, 0, pi / 2 * (k % 4)}) * leans;
      const auto f = at({0.1 * (k / 4 % 3), 0.1 * (k / 12), 0}, {{}, R.x, R.y, R.z});
      const SolidOverlaps in = find_overlaps(s, f, comb, false), around = find_overlaps(s, f, comb, true);
      ASSERT_TRUE(in.definite && around.definite) << k;
      if (in.engulfed || around.engulfed) continue;
      for (const SolidOverlap& o : in.volumes) EXPECT_LT(o.volume, whole(s)) << k;
      for (const SolidOverlap& o : around.volumes) EXPECT_GT(o.volume, 0) << k;
      EXPECT_NEAR(sums(in)[0] + sums(around)[0], whole(s), 1e-9) << k;
      seen += in.volumes.size() > 1;
    }
  }
  EXPECT_GT(seen, 60);
}

}  // namespace dynalin::torus_overlap_test

// Cylinders, frusta and ellipsoids with bodies of facets that are not convex, and in cavities of facets: volumes in
// common, where they push and how that changes.
#include "geometry/solid_overlap_touch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/overlap_test_support.h"
#include "geometry/overlap_touch.h"
#include "geometry/polygon.h"
#include "geometry/prism.h"
#include "geometry/revolution.h"
#include "geometry/solid_overlap.h"

namespace dynalin::solid_overlap_touch_test {
namespace {

using namespace overlap_test;

// A floor at y = 0 with an edge turned up far away, which makes it hollow there.
FacetBody floor_with_edge() { return swept({{-2, -0.5}, {2, -0.5}, {2, 0.5}, {1.9, 0.5}, {1.9, 0}, {-2, 0}}, -2, 2); }
// Ribs 0.1 wide whose tops are at y = 0.
FacetBody comb() {
  return swept({{-0.6, -0.5}, {0.6, -0.5}, {0.6, 0}, {0.5, 0}, {0.5, -0.4}, {-0.5, -0.4}, {-0.5, 0}, {-0.6, 0}}, -1, 1);
}

QuadricSolid egg() { return QuadricSolid(solid::Ellipsoid{{0.3, 0.2, 0.45}}); }
QuadricSolid drum() { return QuadricSolid(solid::Frustum{-0.2, 0.25, 0.4, 0.25}); }
QuadricSolid cup() { return QuadricSolid(solid::Frustum{0.1, 0.35, 0.6, 0.15}); }
QuadricSolid cone() { return QuadricSolid(solid::Frustum{0, 0.3, 0.5, 0}); }
double whole(const QuadricSolid& s) {
  if (!s.has_ends()) return 4 * std::numbers::pi / 3 * s.semi_axes().x * s.semi_axes().y * s.semi_axes().z;
  const double a = s.radius(false), b = s.radius(true);
  return std::numbers::pi / 3 * (s.height(true) - s.height(false)) * (a * a + a * b + b * b);
}

// z of the solid is y of the body.
const RelativeFrame<double> on_end{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
// z of the solid is x of the body.
const RelativeFrame<double> lying{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};

class solid_overlap_touch : public Poses {};

}  // namespace

// Drawn in ever more facets, which are on and in its surface, it has the volumes of the solid but for the square of
// their size; so have all touches.
TEST_F(solid_overlap_touch, is_what_it_comes_to_with_finely_drawn_solids) {
  const auto drawn = [](const QuadricSolid& s, std::size_t count) {
    if (!s.has_ends()) return FacetBody(ellipsoid(s.semi_axes(), count));
    std::vector<Meridian> profile{{0, s.height(false)}};
    profile.push_back({s.radius(false), s.height(false)});
    if (s.radius(true) > 0) profile.push_back({s.radius(true), s.height(true)});
    profile.push_back({0, s.height(true)});
    return FacetBody(revolved(profile, false, {.segments = count}));
  };
  const FacetBody a = angle(), s = star(5);
  for (const QuadricSolid& solid : {egg(), drum(), cup(), cone()}) {
    const FacetBody coarse = drawn(solid, 30), fine = drawn(solid, 60);
    int seen = 0;
    for (int k = 0; k < 40; ++k) {
      const FacetBody& J = k % 2 == 0 ? a : s;
      const auto f = pose(0.35, {0.2, 0.2, 0});
      const SolidOverlaps exact = find_overlaps(solid, f, J, false);
      ASSERT_TRUE(exact.definite);
      const Overlaps one = find_overlaps(coarse, f, J, false), other = find_overlaps(fine, f, J, false);
      if (exact.engulfed || one.volumes.size() != exact.volumes.size() || other.volumes.size() != exact.volumes.size())
        continue;
      const auto sums = [](const auto& volumes) {
        std::array<double, 4> sum{};
        for (const auto& o : volumes) {
          const Vector moment = o.moment + o.origin * o.volume;
          sum[0] += o.volume;
          for (std::size_t c = 0; c < 3; ++c) sum[c + 1] += moment[c];
        }
        return sum;
      };
      const auto e = sums(exact.volumes), c = sums(one.volumes), d = sums(other.volumes);
      for (std::size_t n = 0; n < 4; ++n) {
        EXPECT_NEAR(c[n], e[n], 2e-2 * whole(solid)) << k;
        // Extrapolated.
        EXPECT_NEAR((4 * d[n] - c[n]) / 3, e[n], 4e-4 * whole(solid)) << k << ' ' << n;
      }
      for (const SolidOverlap& o : exact.volumes) {
        double of_facets = 0;
        for (const auto& p : o.of_J) of_facets += p.area;
        EXPECT_GT(o.curved.area + o.low.area + o.high.area, 0);
        EXPECT_GT(of_facets, 0);
        ++seen;
      }
    }
    EXPECT_GT(seen, 15);
  }
}

TEST_F(solid_overlap_touch, changes_as_the_bodies_move) {
  const FacetBody a = angle(), s = star(5);
  int seen = 0, several = 0, hollow = 0;
  for (const QuadricSolid& solid : {egg(), drum(), cup(), cone()}) {
    for (int k = 0; k < 60; ++k) {
      const FacetBody& J = k % 2 == 0 ? a : s;
      const bool cavity = k % 5 == 4;
      const auto f = pose(cavity ? 0.2 : 0.5, {0.2, 0.2, 0});
      const auto list = seeded_touches(solid, f, J, cavity);
      const auto unlike = [](const auto& t) { return !t.defined || t.seam < 1e-4 || t.gap.value < -0.25; };
      if (list.empty() || std::ranges::any_of(list, unlike)) continue;
      ++seen, several += list.size() > 1, hollow += cavity;
      SCOPED_TRACE(k);
      expect_differences(list, solid, f, J, 5e-5, cavity);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(seen, 60);
  EXPECT_GT(several, 3);
  EXPECT_GT(hollow, 5);
}

// An end on a face: as deep as it is, in its middle, and nothing turns it.
TEST_F(solid_overlap_touch, of_an_end_that_stands_on_a_face_is_in_its_middle) {
  const FacetBody J = floor_with_edge();
  for (const QuadricSolid& solid : {drum(), cup()}) {
    const auto list = seeded_touches(solid, at({0.3, -0.01 - solid.height(false), 0.2}, on_end), J);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_TRUE(list[0].defined);
    EXPECT_EQ(value_of(list[0].normal).y, 1);
    // Means are made for what widens away from its point; of the cup, which narrows, they say a little more.
    const bool straight = solid.slope() == 0;
    expect_near(value_of(list[0].point), {0.3, -0.005, 0.2}, straight ? 1e-12 : 1e-3);
    const std::array<double, 6> wanted{0, 1, 0, 0, 0, 0};
    EXPECT_NEAR(list[0].gap.value, -0.01, straight ? 1e-12 : 4e-4);
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(list[0].gap.partial[k], wanted[k], k == 1 && !straight ? 0.1 : 1e-9) << k;
  }
}

// As deep as it is: the centroid is above the deepest line. As it leans along z of the body it rolls; along its own
// axis the centroid of a wedge moves by w L²/12 of the area S of the segment, and what is below the middle with it.
TEST_F(solid_overlap_touch, of_a_mantle_that_lies_on_a_face_is_as_deep_as_it_is) {
  constexpr double r = 0.25, length = 0.6;
  for (const double depth : {1e-4, 1e-3, 0.02}) {
    const auto list = seeded_touches(drum(), at({0.3, r - depth, 0.2}, lying), floor_with_edge());
    ASSERT_EQ(list.size(), 1u);
    const Touch<Seeded>& t = list.front();
    EXPECT_TRUE(t.defined);
    EXPECT_EQ(value_of(t.normal).y, 1);
    EXPECT_NEAR(t.gap.value, -depth, 1e-12);
    EXPECT_NEAR(t.gap.partial[1], 1, 1e-9);
    EXPECT_NEAR(t.gap.partial[3], 0, 1e-9);
    expect_near(value_of(t.point), {0.4, -0.5 * depth, 0.2}, 1e-9);
    EXPECT_NEAR(t.point.z.partial[3], 0, 1e-6);
    const double half = std::acos(1 - depth / r), chord = 2 * r * std::sin(half),
                 area = r * r * (half - std::sin(half) * std::cos(half)),
                 below = chord * chord * chord / 12 / area;  // the middle: the centroid of the segment
    // It turns about the origin, 0.1 beside its middle.
    EXPECT_NEAR(t.point.x.partial[5], below - chord * length * length / 12 / area, 1e-6 * length * length / depth);
  }
}

// As deep as it is, and as it leans it rolls: the deepest place moves by its radii of curvature.
TEST_F(solid_overlap_touch, of_an_ellipsoid_in_a_face_is_as_deep_as_it_is) {
  constexpr double a = 0.3, b = 0.2, c = 0.45;
  for (const double depth : {1e-4, 1e-3, 0.02}) {
    const auto list = seeded_touches(egg(), at({0.3, b - depth, 0.2}), floor_with_edge());
    ASSERT_EQ(list.size(), 1u);
    EXPECT_TRUE(list[0].defined);
    EXPECT_NEAR(list[0].gap.value, -depth, 1e-12);
    EXPECT_NEAR(list[0].gap.partial[1], 1, 1e-9);
    expect_near(value_of(list[0].point), {0.3, -0.5 * depth, 0.2}, 1e-9);
    EXPECT_NEAR(list[0].point.x.partial[5], b - a * a / b, 0.2 * (a * a / b));
    EXPECT_NEAR(list[0].point.z.partial[3], c * c / b - b, 0.2 * (c * c / b));
  }
}

// From the first touch on it is as deep as it is, and nowhere in doubt.
TEST_F(solid_overlap_touch, of_a_first_touch_is_as_deep_as_it_is) {
  for (double depth = 1e-13; depth < 1e-3; depth *= 3) {
    for (const auto& [solid, f] :
         {std::pair(drum(), at({0.3, 0.25 - depth, 0.2}, lying)),
          std::pair(drum(), at({0.3, 0.2 - depth, 0.2}, on_end)), std::pair(egg(), at({0.3, 0.2 - depth, 0.2}))}) {
      std::vector<Touch<double>> list(most_overlaps);
      touch_overlaps<double>(solid, f, floor_with_edge(), false, list);
      EXPECT_TRUE(list.front().defined) << depth;
      EXPECT_NEAR(-list.front().gap, depth, 5e-12 + 3e-4 * depth);
    }
  }
}

TEST_F(solid_overlap_touch, of_a_rod_across_ribs_has_one_place_on_each) {
  const QuadricSolid rod(solid::Frustum{-0.9, 0.1, 0.9, 0.1});
  const auto list = seeded_touches(rod, at({0, 0.09, 0.2}, lying), comb());
  ASSERT_EQ(list.size(), 2u);
  for (const auto& t : list) {
    EXPECT_TRUE(t.defined);
    expect_near(value_of(t.normal), {0, 1, 0}, 1e-12);
    EXPECT_NEAR(std::abs(t.point.x.value), 0.55, 1e-10);
    EXPECT_NEAR(t.gap.value, -0.01, 1e-12);
  }
  EXPECT_LT(list[0].point.x.value * list[1].point.x.value, 0);
  // Its end on one of them, its mantle on the other.
  const auto at_end = touches(rod, at({0.35, 0.09, 0.2}, lying), comb());
  ASSERT_EQ(at_end.size(), 2u);
  EXPECT_NEAR(std::max(at_end[0].point.x, at_end[1].point.x), 0.55, 1e-10);
  EXPECT_NEAR(std::min(at_end[0].point.x, at_end[1].point.x), -0.525, 1e-3);  // reached over by the end of the rod
}

// Beside an edge of the face it reaches over: that side does not count.
TEST_F(solid_overlap_touch, of_what_reaches_over_an_edge_is_across_the_faces) {
  const FacetBody J = floor_with_edge();
  for (const double depth : {1e-4, 1e-3}) {
    auto list = touches(drum(), at({-2, 0.2 - depth, 0.2}, on_end), J);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_TRUE(list[0].defined);
    expect_near(list[0].normal, {0, 1, 0}, 1e-12);
    EXPECT_NEAR(list[0].gap, -depth, 1e-10);
    EXPECT_NEAR(list[0].point.x, -2 + 4 * 0.25 / (3 * std::numbers::pi), 1e-9);
    list = touches(drum(), at({-2, 0.25 - depth, 0.2}, lying), J);
    ASSERT_EQ(list.size(), 1u);
    expect_near(list[0].normal, {0, 1, 0}, 1e-12);
    EXPECT_NEAR(list[0].point.x, -1.8, 1e-9);
  }
}

TEST_F(solid_overlap_touch, has_no_direction_all_around_and_wholly_inside) {
  const FacetBody a = angle();
  const QuadricSolid pin(solid::Frustum{-2, 0.05, 2, 0.05}), crumb(solid::Ellipsoid{{0.02, 0.03, 0.04}});
  const auto through = touches(pin, at({0.2, 0.15, 0}), a), inside = touches(crumb, at({0.2, 0.2, 0}), a);
  ASSERT_EQ(through.size(), 1u);
  EXPECT_FALSE(through[0].defined);
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_FALSE(inside[0].defined);
  // A body wholly in a solid.
  const FacetBody grain = swept({{0, 0}, {0.1, 0}, {0.1, 0.03}, {0.04, 0.03}, {0.04, 0.09}, {0, 0.09}}, -0.03, 0.04);
  const auto around = touches(drum(), at({0, 0, 0}), grain);
  ASSERT_EQ(around.size(), 1u);
  EXPECT_FALSE(around[0].defined);
}

TEST_F(solid_overlap_touch, in_a_cavity_is_that_with_its_walls) {
  const FacetBody room = facets_of_box({-1, -1, -1}, {1, 1, 1});
  for (const QuadricSolid& solid : {egg(), drum()}) {
    EXPECT_EQ(touches(solid, at({0, 0.1, 0}), room, true).size(), 0u);
    const double reach = solid.farthest({1, 0, 0}).x;
    const auto list = touches(solid, at({1.01 - reach, 0.1, 0}), room, true);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_TRUE(list[0].defined);
    EXPECT_NEAR(list[0].gap, -0.01, 1e-3);
    expect_near(list[0].normal, {-1, 0, 0}, 1e-12);
  }
}

TEST_F(solid_overlap_touch, what_is_apart_is_as_far_as_the_nearest_facet) {
  const auto gap = [](const QuadricSolid& I, const RelativeFrame<double>& f, const FacetBody& J) {
    std::vector<Touch<double>> open(most_overlaps);
    touch_overlaps<double>(I, f, J, false, open);
    EXPECT_FALSE(open.front().closed());
    return open.front().gap;
  };
  EXPECT_NEAR(gap(drum(), at({0.3, 0.27, 0.2}, lying), floor_with_edge()), 0.02, 1e-12);
  EXPECT_NEAR(gap(drum(), at({0.3, 0.23, 0.2}, on_end), floor_with_edge()), 0.03, 1e-12);
  // At least, and 0 as they meet.
  EXPECT_NEAR(gap(egg(), at({0.3, 0.2 + 1e-9, 0.2}), floor_with_edge()), 1e-9, 1e-12);
  EXPECT_LE(gap(egg(), at({0.3, 0.3, 0.2}), floor_with_edge()), 0.1);
}

// Only of a cone whose point is in a face some are left open.
TEST_F(solid_overlap_touch, of_bodies_drawn_on_one_grid_is_definite) {
  const std::array<QuadricSolid, 5> solids{
      QuadricSolid(solid::Ellipsoid{{0.25, 0.125, 0.5}}), QuadricSolid(solid::Frustum{0, 0.25, 0.5, 0.25}),
      QuadricSolid(solid::Frustum{-0.5, 0.25, 0, 0.125}), QuadricSolid(solid::Frustum{0, 0.0625, 1.5, 0.0625}),
      QuadricSolid(solid::Frustum{0, 0.5, 0.0625, 0.5})};
  expect_definite_on_one_grid(solids, 4000, 20, whole);
}

}  // namespace dynalin::solid_overlap_touch_test

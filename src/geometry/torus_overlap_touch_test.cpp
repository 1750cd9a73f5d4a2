// Rings with bodies of facets that are not convex, and in cavities of facets: where they push and how that changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/polygon.h"
#include "geometry/revolution.h"
#include "geometry/solid_overlap_touch.h"
#include "geometry/torus_test_support.h"

namespace dynalin::torus_overlap_touch_test {
namespace {

using namespace overlap_test;
using namespace torus_test;

class torus_overlap_touch : public Poses {};

}  // namespace
TEST_F(torus_overlap_touch, changes_as_the_bodies_move) {
  const FacetBody a = angle(), s = star(5);
  int seen = 0, several = 0, hollow = 0;
  for (const TorusSolid& solid : {ring(), bun()}) {
    for (int k = 0; k < 150; ++k) {
      const FacetBody& J = k % 2 == 0 ? a : s;
      const bool cavity = k % 5 == 4;
      const auto f = pose(cavity ? 0.2 : 0.5, {0.2, 0.2, 0});
      const auto list = seeded_touches(solid, f, J, cavity);
      const auto unlike = [](const auto& t) {
        return !t.defined || t.seam < 1e-4 || std::abs(t.gap.value + 0.126) > 0.125;
      };
      if (list.empty() || std::ranges::any_of(list, unlike)) continue;
      ++seen, several += list.size() > 1, hollow += cavity;
      SCOPED_TRACE(k);
      expect_differences(list, solid, f, J, 5e-5, cavity);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(seen, 40);
  EXPECT_GT(several, 5);
  EXPECT_GT(hollow, 2);
}

// As deep as it is on edge, where it rolls: the deepest place moves by its radii of curvature, that of the tube less
// what the circle about the axis has.
TEST_F(torus_overlap_touch, on_edge_is_as_deep_as_it_is) {
  const TorusSolid s = ring();
  const double outer = s.major() + s.minor();
  for (const double depth : {1e-4, 1e-3, 0.02}) {
    const auto list = seeded_touches(s, at({0.3, outer - depth, 0.2}), floor_with_edge());
    ASSERT_EQ(list.size(), 1u);
    EXPECT_TRUE(list[0].defined);
    EXPECT_EQ(value_of(list[0].normal).y, 1);
    EXPECT_NEAR(list[0].gap.value, -depth, 1e-12);
    EXPECT_NEAR(list[0].gap.partial[1], 1, 1e-9);
    expect_near(value_of(list[0].point), {0.3, -0.5 * depth, 0.2}, 1e-9);
    EXPECT_NEAR(list[0].point.x.partial[5], 0, 1e-6);
    EXPECT_NEAR(list[0].point.z.partial[3], s.minor() - outer, 0.1 * outer);
  }
}

// Flat it is held in its middle, by a trough all around that is nearly one of a parabola; as it leans it rights itself.
TEST_F(torus_overlap_touch, lying_flat_is_held_in_the_middle) {
  const TorusSolid s = ring();
  for (const double depth : {1e-5, 1e-4, 1e-3, 0.01}) {
    const auto list = seeded_touches(s, at({0.3, s.minor() - depth, 0.2}, flat), floor_with_edge());
    ASSERT_EQ(list.size(), 1u);
    const Touch<Seeded>& t = list.front();
    EXPECT_TRUE(t.defined);
    EXPECT_EQ(value_of(t.normal).y, 1);
    EXPECT_NEAR(t.gap.value, -depth, 0.1 * depth * depth / s.minor());
    EXPECT_NEAR(t.gap.partial[1], 1, 0.2 * depth / s.minor());
    expect_near(value_of(t.point), {0.3, t.gap.value / 2, 0.2}, 1e-8);
    // About x: the weight of a trough w wide, V = 2/3 · 2 π R w d, has the moment of its footprint, π R³ w, along z.
    EXPECT_NEAR(t.point.z.partial[3] * depth, 0.75 * s.major() * s.major(), 0.1 * s.major() * s.major());
    EXPECT_NEAR(t.gap.partial[3], 0, 1e-6);
  }
}

// On a peg through it, as a shackle hangs: at the top of its inner side, with the normal across the peg's upper edge.
TEST_F(torus_overlap_touch, hangs_on_a_peg_that_goes_through_it) {
  // A bracket: a post with an arm at its top, 0.2 wide.
  const FacetBody bracket = swept({{-1, -2}, {-0.8, -2}, {-0.8, -0.2}, {1, -0.2}, {1, 0}, {-1, 0}}, -0.1, 0.1);
  const TorusSolid s = ring();
  // Its axis along the arm, whose upper edges its inner side meets 0.001 deep.
  const RelativeFrame<double> hung{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};
  const double inner = s.major() - s.minor(), beside = std::sqrt(inner * inner - 0.01);
  const auto list = touches(s, at({0.3, -0.001 - beside, 0}, hung), bracket);
  ASSERT_EQ(list.size(), 2u);  // on each edge of the arm one
  double along = 0;
  for (const Touch<double>& t : list) {
    EXPECT_TRUE(t.defined);
    EXPECT_NEAR(t.point.x, 0.3, 1e-3);
    EXPECT_NEAR(std::abs(t.point.z), 0.1, 5e-3);
    EXPECT_GT(t.normal.y, 0.9);
    along += t.normal.z;
  }
  EXPECT_NEAR(along, 0, 1e-9);
  EXPECT_TRUE(touches(s, at({0.3, 0.001 - beside, 0}, hung), bracket).empty());
}

TEST_F(torus_overlap_touch, of_a_first_touch_is_as_deep_as_it_is) {
  const TorusSolid s = ring();
  for (double depth = 1e-13; depth < 1e-3; depth *= 3) {
    for (const bool lies : {false, true}) {
      const auto f = lies ? at({0.3, s.minor() - depth, 0.2}, flat) : at({0.3, s.major() + s.minor() - depth, 0.2});
      std::vector<Touch<double>> list(most_overlaps);
      touch_overlaps<double>(s, f, floor_with_edge(), false, list);
      EXPECT_TRUE(list.front().defined) << depth;
      // Of a trough all around that is as thin the volume is known to that.
      EXPECT_NEAR(-list.front().gap, depth, (lies ? 2e-9 : 5e-12) + 2e-3 * depth);
    }
  }
}

TEST_F(torus_overlap_touch, has_no_direction_all_around_and_wholly_inside) {
  // In a bore that is too small for it all around, open at one side of its wall.
  const std::vector<Meridian> outline{{0.55, -0.3}, {0.9, -0.3}, {0.9, 0.3}, {0.55, 0.3}};
  const FacetBody bore(revolved(outline, true, {.segments = 24}));
  const auto around = touches(ring(), at({0, 0, 0}), bore);
  ASSERT_EQ(around.size(), 1u);
  EXPECT_FALSE(around[0].defined);
  const FacetBody a = angle();
  const auto inside = touches(TorusSolid({0.05, 0.02}), at({0.2, 0.2, 0}), a);
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_FALSE(inside[0].defined);
  const FacetBody grain = swept({{0, 0}, {0.1, 0}, {0.1, 0.03}, {0.04, 0.03}, {0.04, 0.09}, {0, 0.09}}, -0.03, 0.04);
  const auto grown_in = touches(TorusSolid({0.5, 0.2}), at({0.55, 0, 0}), grain);
  ASSERT_EQ(grown_in.size(), 1u);
  EXPECT_FALSE(grown_in[0].defined);
  // Right through a wall.
  const FacetBody wall = swept({{-0.05, -2}, {2, -2}, {2, -1.5}, {0.05, -1.5}, {0.05, 2}, {-0.05, 2}}, -2, 2);
  const auto through = touches(ring(), at({0, 0, 0}), wall);
  ASSERT_EQ(through.size(), 2u);
  EXPECT_FALSE(through[0].defined);
  // Its whole surface is in the floor.
  const auto sunk = touches(ring(), at({0, -0.5, 0}, flat), floor_with_edge());
  ASSERT_EQ(sunk.size(), 1u);
  EXPECT_FALSE(sunk[0].defined);
}

TEST_F(torus_overlap_touch, in_a_cavity_is_that_with_its_walls) {
  const FacetBody room = facets_of_box({-1, -1, -1}, {1, 1, 1});
  const TorusSolid s = ring();
  EXPECT_EQ(touches(s, at({0, 0.1, 0}), room, true).size(), 0u);
  for (const double depth : {1e-3, 0.01}) {
    const auto list = touches(s, at({1 - 0.6 + depth, 0.1, 0}), room, true);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_TRUE(list[0].defined);
    EXPECT_NEAR(list[0].gap, -depth, 1e-3 * depth);
    expect_near(list[0].normal, {-1, 0, 0}, 1e-12);
  }
}

TEST_F(torus_overlap_touch, what_is_apart_is_as_far_as_the_nearest_facet) {
  const auto gap = [](const TorusSolid& I, const RelativeFrame<double>& f, const FacetBody& J) {
    std::vector<Touch<double>> open(most_overlaps);
    touch_overlaps<double>(I, f, J, false, open);
    EXPECT_FALSE(open.front().closed());
    return open.front().gap;
  };
  const TorusSolid s = ring();
  EXPECT_NEAR(gap(s, at({0.3, 0.62, 0.2}), floor_with_edge()), 0.02, 1e-12);
  EXPECT_NEAR(gap(s, at({0.3, 0.13, 0.2}, flat), floor_with_edge()), 0.03, 1e-12);
  // A thin needle through its hole: from its edge.
  const FacetBody needle = swept({{0.35, -0.001}, {0.352, 0}, {0.35, 0.001}, {0.351, 0}}, -1, 1);
  EXPECT_NEAR(gap(s, at({0, 0, 0}), needle), 0.5 - 0.352 - 0.1, 1e-12);
  // The nearest of many places of both.
  const FacetBody a = angle();
  int seen = 0;
  for (int k = 0; k < 60; ++k) {
    const auto f = pose(1.2, {0.2, 0.2, 0});
    std::vector<Touch<double>> open(most_overlaps);
    touch_overlaps<double>(s, f, a, false, open);
    if (open.front().closed()) continue;
    double least = 10;
    for (int n = 0; n < 4000; ++n) {
      const double u = 2 * pi * n / 4000;
      const Vector p = f.p + f.x * (s.major() * std::cos(u)) + f.y * (s.major() * std::sin(u));
      least = std::min(least, std::abs(a.nearest(p).distance) - s.minor());
    }
    EXPECT_NEAR(open.front().gap, least, 1e-4);
    ++seen;
  }
  EXPECT_GT(seen, 20);
}

}  // namespace dynalin::torus_overlap_touch_test

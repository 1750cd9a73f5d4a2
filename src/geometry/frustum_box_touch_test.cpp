// A frustum and a box, or an end as flat as the face of one.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/frustum_test_support.h"

namespace dynalin::frustum_box_touch_test {
namespace {

using frustum_test::Box;
using frustum_test::closed;
using frustum_test::drum;
using frustum_test::Frame;
using frustum_test::Frustum;
using frustum_test::lying;
using frustum_test::Pair;
using frustum_test::resultant;
using frustum_test::roller;
using frustum_test::table;

TEST(FrustumBoxTouch, cylinder_lies_on_a_box_with_both_rims_or_the_edge_below_it) {
  const Pair p{"", {roller}, {table}};
  auto list = closed(p, lying(0.3, {0.2, 0.1, 0.099}));
  ASSERT_EQ(list.size(), 2u);
  for (const Touch<double>& t : list) {
    EXPECT_NEAR(t.gap, -1e-3, 1e-15);
    EXPECT_LT(norm(t.normal - Vector{0, 0, 1}), 1e-15);
  }
  list = closed(p, lying(0, {1.8, 0.1, 0.099}));
  ASSERT_EQ(list.size(), 2u);
  EXPECT_NEAR(list[0].point.x + list[1].point.x, 1.3 + 2, 1e-12);
  // Over an edge along it, then at both ends about that edge.
  for (const double beyond : {-0.01, 0.0, 0.03}) {
    const Vector arm{0, beyond, std::sqrt(0.099 * 0.099 - (beyond > 0 ? beyond * beyond : 0))};
    const auto sum = resultant(p, lying(0, {0.3, 2 + arm.y, arm.z}));
    const double lean = beyond > 0 ? beyond / 0.099 : 0;
    EXPECT_NEAR(sum[1], 2e-3 * lean, 1e-12) << beyond;
    EXPECT_NEAR(sum[2], 2e-3 * std::sqrt(1 - lean * lean), 1e-12) << beyond;
    EXPECT_NEAR(sum[4], -0.3 * sum[2], 1e-12) << beyond;
  }
}

TEST(FrustumBoxTouch, force_is_continuous_where_a_cylinder_leaves_over_an_edge) {
  const Pair p{"", {roller}, {table}};
  for (const double angle : {0.0, 1e-4, 0.05, 0.7, 1.5}) {
    auto before = resultant(p, lying(angle, {0.2, 1.4, 0.098}));
    for (double y = 1.4; y < 2.02; y += 1e-4) {
      const auto now = resultant(p, lying(angle, {0.2, y, 0.098}));
      for (const std::size_t k : {1u, 2u}) EXPECT_LT(std::abs(now[k] - before[k]), 5e-5) << angle << " " << y;
      before = now;
    }
  }
}

TEST(FrustumBoxTouch, box_stands_on_an_end_with_its_corners) {
  const Box plate{{-0.2, -0.3, -0.1}, {0.2, 0.3, 0.1}};
  const Pair p{"", {plate}, {drum}};
  auto list = closed(p, {{0.05, -0.02, 1.099}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  ASSERT_EQ(list.size(), 4u);
  for (const Touch<double>& t : list) EXPECT_NEAR(t.gap, -1e-3, 1e-15);
  // And a roller with both rims, or its line over the rim of the drum.
  const Pair q{"", {roller}, {Frustum{-1, 0.7, 1, 0.7}}};
  list = closed(q, lying(0.3, {0, 0, 1.099}));
  ASSERT_EQ(list.size(), 2u);
  list = closed(q, lying(0, {0.4, 0, 1.099}));
  ASSERT_EQ(list.size(), 2u);
  EXPECT_NEAR(list[0].point.x + list[1].point.x, -0.1 + 0.7, 1e-12);
  // Exactly over it each of both holds half.
  for (const double x : {0.19, 0.2, 0.21}) EXPECT_NEAR(resultant(q, lying(0, {x, 0, 1.099}))[2], 2e-3, 1e-12) << x;
}

// A brick that slides flat over an end and out over its rim, at any angle: the outline of what both have in common
// turns once around, by right angles at corners of the brick in it, by other angles where edges pass over the rim, and
// along the rest of the rim. Each right angle has the force of one corner, and nothing jumps.
TEST(FrustumBoxTouch, corners_that_leave_over_a_rim_hand_their_force_to_edges) {
  const Box brick{{-0.2, -0.3, 0}, {0.2, 0.3, 0.4}};
  const Frustum disc{-0.1, 1, 0, 1};
  const double depth = 1e-3;
  for (const double angle : {0.0, 0.3, 0.7, 1.2}) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (double x = 0.6; x < 1.15; x += 5e-4) {
      const auto places = closed({"", {brick}, {disc}}, {{x, 0.05, -depth}, {c, s, 0}, {-s, c, 0}, {0, 0, 1}});
      double weights = 0;
      for (const Touch<double>& t : places) {
        weights += t.weight;
        EXPECT_NEAR(t.gap, -depth, 1e-9);
      }
      // How much of the rim is under the brick.
      const int parts = 20000;
      int under = 0;
      for (int k = 0; k < parts; ++k) {
        const double a = 2 * std::numbers::pi * (k + 0.5) / parts;
        const double u = std::cos(a) - x, v = std::sin(a) - 0.05;
        under += std::abs(c * u + s * v) < 0.2 && std::abs(c * v - s * u) < 0.3;
      }
      EXPECT_NEAR(weights, 4 - 4.0 * under / parts, 1e-3) << angle << " " << x;
    }
  }
}

// An end over the edge of a table, deepest where the edge leaves over the rim: there once.
TEST(FrustumBoxTouch, rim_over_an_edge_meets_it_once) {
  const double tilt = 0.02, s = std::sin(tilt), c = std::cos(tilt);
  // The end at z = -1 of the drum, lower against x.
  const Vector z{-s, 0, c}, centre{0, 2.2, 0.005};
  const auto list = closed({"", {drum}, {table}}, {centre + z, {c, 0, s}, {0, 1, 0}, z});
  int there = 0;
  for (const Touch<double>& t : list) {
    EXPECT_EQ(t.weight, 1);
    there += norm(t.point - Vector{-std::sqrt(0.25 - 0.04), 2, 0}) < 0.02 ||
             norm(t.point - Vector{std::sqrt(0.25 - 0.04), 2, 0}) < 0.02;
  }
  EXPECT_EQ(there, 1);
  EXPECT_EQ(list.size(), 1u);
}

// In its middle where it is flat; on the circle from an inclination of a ten-thousandth on; and between them as the
// derivative of the depth says.
TEST(FrustumBoxTouch, rim_that_stands_flat_bears_in_its_middle) {
  struct Support {
    Pair pair;
    double top;
  };
  for (const Support& on : {Support{{"", {roller}, {table}}, 0}, {{"", {roller}, {drum}}, 1}}) {
    const Pair& pair = on.pair;
    const auto inclined = [&](double angle) {
      return Frame{{0.1, 0, on.top + 0.499},
                   {std::cos(angle), 0, -std::sin(angle)},
                   {0, 1, 0},
                   {std::sin(angle), 0, std::cos(angle)}};
    };
    const auto flat = closed(pair, inclined(0));
    ASSERT_EQ(flat.size(), 1u);
    EXPECT_TRUE(flat[0].defined);
    EXPECT_NEAR(flat[0].point.x, 0.1, 1e-12);
    EXPECT_NEAR(flat[0].gap, -0.001 - 0.375 * 1e-4 * 0.1, 1e-12);
    constexpr double step = 1e-8;
    for (const double angle : {1e-6, 5e-5, 9.9e-5, 2e-4}) {
      const auto here = closed(pair, inclined(angle));
      ASSERT_EQ(here.size(), 1u) << angle;
      const double slope =
          (closed(pair, inclined(angle + step))[0].gap - closed(pair, inclined(angle - step))[0].gap) / (2 * step);
      // Turning about y through the centre by an angle lowers what is at x from it by x.
      EXPECT_NEAR(slope, -(here[0].point.x - 0.1), 1e-6) << angle;
      if (angle > 1e-4) {
        EXPECT_NEAR(here[0].point.x - 0.1, 0.1 * std::cos(angle) - 0.5 * std::sin(angle), 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace dynalin::frustum_box_touch_test

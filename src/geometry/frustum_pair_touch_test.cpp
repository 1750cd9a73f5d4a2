// Two frustums.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "geometry/frustum_test_support.h"

namespace dynalin::frustum_pair_touch_test {
namespace {

using frustum_test::closed;
using frustum_test::Frame;
using frustum_test::Frustum;
using frustum_test::largest_separation;
using frustum_test::Pair;
using frustum_test::resultant;
using frustum_test::roller;

// One place where two lines cross, whatever their angle, with its whole force.
TEST(FrustumPairTouch, crossed_cylinders_meet_on_their_common_perpendicular) {
  const Pair p{"", {roller}, {Frustum{-1, 0.3, 1, 0.3}}};
  for (const double angle : {1.5707963267948966, 0.8, 0.02}) {
    // The lower one along z of J: the upper one in the plane x = 0.4.
    const Frame at{{0.4 - 1e-3, 0.005, 0.1},
                   {1, 0, 0},
                   {0, std::cos(angle), -std::sin(angle)},
                   {0, std::sin(angle), std::cos(angle)}};
    const auto list = closed(p, at);
    ASSERT_EQ(list.size(), 1u) << angle;
    EXPECT_NEAR(list[0].gap, -1e-3, 1e-15);
    EXPECT_EQ(list[0].weight, 1);
    EXPECT_LT(norm(list[0].normal - Vector{1, 0, 0}), 1e-12);
    EXPECT_LT(norm(list[0].point - Vector{0.2995, 0, 0.1 - 0.005 / std::tan(angle)}), 1e-12) << angle;
  }
}

// Both ends of what they have in common; as they turn away from each other one place takes over.
TEST(FrustumPairTouch, parallel_cylinders_meet_at_both_ends) {
  const Pair p{"", {roller}, {Frustum{-1, 0.3, 1, 0.3}}};
  const auto turned = [](double angle, const Vector& at) {
    return Frame{at, {1, 0, 0}, {0, std::cos(angle), -std::sin(angle)}, {0, std::sin(angle), std::cos(angle)}};
  };
  for (const double shift : {0.0, 0.2, 0.8}) {
    const auto list = closed(p, turned(0, {0.399, 0, shift}));
    ASSERT_EQ(list.size(), 2u) << shift;
    double ends = 0;
    for (const Touch<double>& t : list) {
      EXPECT_NEAR(t.gap, -1e-3, 1e-15);
      EXPECT_EQ(t.weight, 1);
      ends += t.point.z;
    }
    EXPECT_NEAR(ends, shift - 0.5 + std::min(1.0, shift + 0.5), 1e-12);
  }
  auto before = resultant(p, turned(0, {0.399, 0, 0.2}));
  for (double angle = 0; angle < 0.02; angle += 2e-5) {
    const auto now = resultant(p, turned(angle, {0.399, 0, 0.2}));
    EXPECT_LT(std::abs(now[0] - before[0]), 1e-5) << angle;
    before = now;
  }
  EXPECT_NEAR(before[0], 1e-3, 1e-9);
}

// What the ends lose between both angles the crossing gains: by 3z² − 2z³ of sin².
TEST(FrustumPairTouch, ends_pass_into_a_crossing_by_a_cubic) {
  const Pair p{"", {roller}, {Frustum{-1, 0.3, 1, 0.3}}};
  for (const double z : {0.25, 0.5, 0.75}) {
    const double sine = std::sqrt(1e-6 + z * (1e-4 - 1e-6)), cosine = std::sqrt(1 - sine * sine);
    const auto list = closed(p, {{0.399, 0, 0.2}, {1, 0, 0}, {0, cosine, -sine}, {0, sine, cosine}});
    ASSERT_EQ(list.size(), 3u);
    const double gained = z * z * (3 - 2 * z);
    EXPECT_NEAR(list[0].weight, gained, 1e-9);
    EXPECT_NEAR(list[1].weight, 1 - gained, 1e-9);
    EXPECT_NEAR(list[2].weight, 1 - gained, 1e-9);
  }
}

// Lines of cones are parallel where their axes are not, and the other way round.
TEST(FrustumPairTouch, parallel_lines_of_cones_meet_at_both_ends) {
  const Frustum taper{-0.5, 0.4, 0.5, 0.2};
  const double slope = std::atan(0.2);
  const Vector line{-std::sin(slope), 0, std::cos(slope)}, across{std::cos(slope), 0, std::sin(slope)};
  // Upside down beside each other.
  auto list =
      closed({"", {taper}, {taper}}, {Vector{0.6 - 1e-3, 0, 0} + 0.1 * line, {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}});
  ASSERT_EQ(list.size(), 2u);
  for (const Touch<double>& t : list) {
    EXPECT_NEAR(t.gap, -1e-3 * std::cos(slope), 1e-12);
    EXPECT_EQ(t.weight, 1);
  }
  // Both with the narrow end up, leaning towards each other.
  const double lean = 2 * slope;
  const Vector z{-std::sin(lean), 0, std::cos(lean)}, x{std::cos(lean), 0, std::sin(lean)};
  // The middle of its line 0.001 beyond that of the other one.
  const Vector on_J{0.3, 0, 0}, at = on_J - 1e-3 * across + 0.1 * line + 0.3 * x;
  list = closed({"", {taper}, {taper}}, {at, x, {0, 1, 0}, z});
  ASSERT_EQ(list.size(), 2u);
  double ends = 0;
  for (const Touch<double>& t : list) {
    EXPECT_NEAR(t.gap, -1e-3, 1e-12);
    EXPECT_EQ(t.weight, 1);
    ends += dot(t.point - on_J, line);
  }
  EXPECT_NEAR(ends, 0.1, 1e-12);
}

// Hardly inclined coins whose rims cross: there, and with all its force, though their mantles are nearly parallel.
TEST(FrustumPairTouch, coins_meet_where_their_rims_cross) {
  const Frustum coin{-0.05, 0.5, 0.05, 0.5};
  const double tilt = 0.005, s = std::sin(tilt), c = std::cos(tilt);
  const auto list = closed({"", {coin}, {coin}}, {{0.7, 0, 0.1 + 1e-3}, {1, 0, 0}, {0, c, -s}, {0, s, c}});
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].weight, 1);
  EXPECT_NEAR(list[0].point.x, 0.35, 1e-3);
  EXPECT_NEAR(list[0].point.y, std::sqrt(0.25 - 0.35 * 0.35), 1e-3);
  EXPECT_NEAR(list[0].gap, 1e-3 - tilt * list[0].point.y, 1e-5);
}

// The deepest point of a tilted cylinder below the end of another one, a little outside of its rim: there the rims meet
// in a direction that is hardly another than that of the end.
TEST(FrustumPairTouch, rims_meet_beside_the_direction_of_an_end) {
  const Frustum cylinder{-0.3, 0.25, 0.3, 0.25};
  const Pair p{"", {cylinder}, {cylinder}};
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(0, 1);
  for (const double outside : {1e-2, 3.4e-4, 1e-5, 1e-7, -1e-7, -1e-4}) {
    for (int draw = 0; draw < 8; ++draw) {
      const double tilt = 0.3 + 0.8 * any(random), about = 2 * M_PI * any(random), towards = 2 * M_PI * any(random);
      const Matrix3 R = rotation_exponential(tilt * Vector{std::cos(about), std::sin(about), 0});
      // The lowest point of the tilted one about its centre, and where it is to be.
      const Vector across = Vector{0, 0, 1} - R.z.z * R.z;
      const Vector lowest = -0.3 * R.z - (0.25 / norm(across)) * across;
      const Vector place =
          (0.25 + outside) * Vector{std::cos(towards), std::sin(towards), 0} + Vector{0, 0, 0.3 - 0.0247};
      const Frame at{place - lowest, R.x, R.y, R.z};
      double deepest = 0;
      for (const Touch<double>& t : closed(p, at)) deepest = std::max(deepest, -t.gap);
      EXPECT_NEAR(deepest, -largest_separation(p, at), 1e-7) << outside << ", " << draw;
    }
  }
}

// As a rim passes over the end of a mantle, both rims meet in directions between that of the mantle and the next one,
// in a wedge that may be as narrow as the axes are parallel, or beside that of an end. The force goes on smoothly.
TEST(FrustumPairTouch, force_is_continuous_where_a_rim_passes_over_another_one) {
  struct Pass {
    Frustum I, J;
    Vector p, x, z;
  };
  for (const Pass& pass : {Pass{{-0.714553499, 0.270739641, 0, 0.270739641},
                                {-0.89134934, 0.377780827, 0, 0.377780827},
                                {0.269582106, -0.582928042, 0.029501708},
                                {-0.901620774, 0.430108672, 0.0456783273},
                                {0.137013506, 0.183843742, 0.973359532}},
                           {{-0.802923515, 0.434335277, 0, 0.434335277},
                            {0, 0.226729362, 0.815357208, 0.226729362},
                            {0.255127128, 0.318944492, 0.371604636},
                            {0.196759723, -0.313247806, -0.929064811},
                            {-0.0874012325, -0.949419831, 0.301600743}}}) {
    const Pair p{"", {pass.I}, {pass.J}};
    const Vector z = normalized(pass.z), x = normalized(pass.x - dot(pass.x, z) * z);
    std::optional<Vector> before;
    for (double shift = -2e-4; shift < 4e-4; shift += 1e-6) {
      const Frame at{pass.p + Vector{0, 0, shift}, x, cross(z, x), z};
      const auto list = closed(p, at);
      ASSERT_EQ(list.size(), 1u) << shift;
      EXPECT_EQ(list[0].weight, 1) << shift;
      const auto sum = resultant(p, at);
      const Vector F{sum[0], sum[1], sum[2]};
      if (before) {
        EXPECT_LT(norm(F - *before), 0.01 * norm(F)) << shift;
      }
      before = F;
    }
    const Frame middle{pass.p + Vector{0, 0, 1e-4}, x, cross(z, x), z};
    EXPECT_NEAR(closed(p, middle)[0].gap, largest_separation(p, middle), 1e-6);
    const Frame on_the_rim{pass.p, x, cross(z, x), z};
    EXPECT_EQ(closed(p, on_the_rim)[0].weight, 1);
  }
}

}  // namespace
}  // namespace dynalin::frustum_pair_touch_test

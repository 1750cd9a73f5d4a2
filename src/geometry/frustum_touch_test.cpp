#include "geometry/frustum_touch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/frustum_test_support.h"
#include "geometry/moved_frame_test_support.h"
#include "places/draws.h"

namespace dynalin::frustum_touch_test {
namespace {

using frustum_test::Box;
using frustum_test::closed;
using frustum_test::drum;
using frustum_test::Frame;
using frustum_test::Frustum;
using frustum_test::largest_separation;
using frustum_test::lying;
using frustum_test::Pair;
using frustum_test::resultant;
using frustum_test::roller;
using frustum_test::Side;
using frustum_test::table;
using frustum_test::touches;

std::vector<Pair> pairs() {
  const Frustum cylinder{-0.4, 0.25, 0.5, 0.25}, cone{-0.3, 0.4, 0.6, 0}, frustum{-0.2, 0.35, 0.4, 0.15},
      disc{-0.05, 0.5, 0.05, 0.5}, rod{-1, 0.06, 1, 0.06}, tip{-0.5, 0, 0.2, 0.3};
  const Box box{{-0.5, -0.4, -0.3}, {0.6, 0.5, 0.4}}, plate{{-0.8, -0.8, -0.05}, {0.8, 0.8, 0.05}},
      bar{{-0.08, -0.1, -1}, {0.07, 0.1, 1}};
  const std::vector<std::pair<std::string, Frustum>> round = {
      {"cylinder", cylinder}, {"cone", cone}, {"frustum", frustum}, {"disc", disc}, {"rod", rod}, {"tip", tip}};
  std::vector<Pair> list;
  for (const auto& [name, f] : round) {
    list.push_back({name + " and box", {f}, {box}});
    list.push_back({name + " and plate", {f}, {plate}});
    list.push_back({name + " and bar", {f}, {bar}});
    for (const auto& [other, g] : round) list.push_back({name + " and " + other, {f}, {g}});
  }
  return list;
}

Frame placed(std::mt19937_64& random) {
  std::normal_distribution<double> any;
  const Matrix3 R = rotation_exponential({any(random), any(random), any(random)});
  return {{0.5 * any(random), 0.5 * any(random), 0.5 * any(random)}, R.x, R.y, R.z};
}
double beyond(const Side& s, const Vector& p) {
  if (const auto* b = std::get_if<Box>(&s.shape))
    return std::max(
        {p.x - b->high.x, b->low.x - p.x, p.y - b->high.y, b->low.y - p.y, p.z - b->high.z, b->low.z - p.z});
  const auto& f = std::get<Frustum>(s.shape);
  const double slope = (f.high_radius - f.low_radius) / (f.high - f.low);
  return std::max({std::hypot(p.x, p.y) - (f.low_radius + slope * (p.z - f.low)), p.z - f.high, f.low - p.z});
}

class FrustumTouch : public ::testing::TestWithParam<Pair> {};

TEST_P(FrustumTouch, one_place_is_as_deep_as_the_sides_are_from_parting) {
  const Pair& p = GetParam();
  std::mt19937_64 random(3);
  const int count = draws(50, 25);
  int apart = 0, together = 0;
  for (int draw = 0; draw < count; ++draw) {
    const Frame at = placed(random);
    const double h = largest_separation(p, at);
    double deepest = 0, nearest = 1;
    for (const Touch<double>& t : touches(p, at)) {
      if (!t.closed()) continue;
      EXPECT_TRUE(t.defined) << draw;
      deepest = std::max(deepest, -t.gap);
      // The search comes close to a ridge and not onto it: it may say too deep.
      if (-t.gap <= -h + 1e-9) nearest = std::min(nearest, -h + t.gap);
      EXPECT_NEAR(norm(t.normal), 1, 1e-12);
      const Vector on_I = t.point + 0.5 * t.gap * t.normal, on_J = t.point - 0.5 * t.gap * t.normal, arm = on_I - at.p;
      EXPECT_NEAR(beyond(p.I, {dot(at.x, arm), dot(at.y, arm), dot(at.z, arm)}), 0, 1e-9) << draw;
      EXPECT_NEAR(beyond(p.J, on_J), 0, 1e-9) << draw;
    }
    ++(h > 0 ? apart : together);
    if (h > 0) {
      EXPECT_EQ(deepest, 0) << draw;
      continue;
    }
    EXPECT_LE(nearest, 1e-3) << draw;
    // What else they have in common may be deeper where they are as deep in each other as they are thick.
    EXPECT_LE(deepest, h > -0.02 ? -1.1 * h + 1e-9 : 2.0) << draw;
  }
  EXPECT_GT(apart, count / 10);
  EXPECT_GT(together, count / 10);
}

// The gap grows by the motion along the normal; normal, point and share are those of differences.
TEST_P(FrustumTouch, duals_are_the_derivatives) {
  const Pair& p = GetParam();
  constexpr double h = 1e-5;
  std::mt19937_64 random(4);
  const int count = draws(60, 20);
  int compared = 0;
  for (int draw = 0; draw < count; ++draw) {
    const Frame at = placed(random);
    const auto along = [](const Vector& v) { return Vec3<Taylor>{Taylor(v.x), Taylor(v.y), Taylor(v.z)}; };
    const auto seeds = path::seeded<12>({along(at.p), along(at.x), along(at.y), along(at.z)});
    const auto values = [](const auto& v) { return Vec3<Dual<12>>{v.x.value, v.y.value, v.z.value}; };
    std::vector<Touch<Dual<12>>> exact(touch_count(p.I, p.J));
    find_touches<Dual<12>>(p.I, p.J, {values(seeds.p), values(seeds.x), values(seeds.y), values(seeds.z)}, exact);
    for (std::size_t c = 0; c < 6; ++c) {
      const auto after = touches(p, moved(at, c, h)), before = touches(p, moved(at, c, -h));
      for (std::size_t t = 0; t < exact.size(); ++t) {
        if (!exact[t].closed() || !after[t].closed() || !before[t].closed()) continue;
        if (norm(after[t].point - before[t].point) > 0.01) continue;  // another corner
        ++compared;
        const Vector n = value_of(exact[t].normal), turn = cross(value_of(exact[t].point) - at.p, n);
        EXPECT_NEAR(exact[t].gap.partial[c], c < 3 ? n[c] : turn[c - 3], 1e-9) << draw << ' ' << t;
        const auto expect = [&](double a, double b, const Dual<12>& of) {
          EXPECT_NEAR((b - a) / (2 * h), of.partial[c], 1e-4 * (1 + std::abs(of.partial[c]))) << draw << ' ' << t;
        };
        expect(before[t].weight, after[t].weight, exact[t].weight);
        for (std::size_t x = 0; x < 3; ++x) {
          expect(before[t].normal[x], after[t].normal[x], exact[t].normal[x]);
          expect(before[t].point[x], after[t].point[x], exact[t].point[x]);
        }
      }
    }
  }
  EXPECT_GT(compared, count / 2);
}

TEST_P(FrustumTouch, exchanged_sides_push_each_other_with_opposite_forces) {
  const Pair& p = GetParam();
  std::mt19937_64 random(5);
  for (int draw = 0; draw < draws(60, 20); ++draw) {
    const Frame f = placed(random);
    const auto from = [&](const Vector& v) { return Vector{dot(f.x, v), dot(f.y, v), dot(f.z, v)}; };
    const Frame back{-from(f.p), {f.x.x, f.y.x, f.z.x}, {f.x.y, f.y.y, f.z.y}, {f.x.z, f.y.z, f.z.z}};
    const auto there = resultant(p, f), here = resultant({p.name, p.J, p.I}, back);
    const Vector F = from({there[0], there[1], there[2]});
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(F[k], -here[k], 1e-9) << draw;
  }
}

std::string test_name(const ::testing::TestParamInfo<Pair>& info) {
  std::string name = info.param.name;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
}
INSTANTIATE_TEST_SUITE_P(pairs, FrustumTouch, ::testing::ValuesIn(pairs()), test_name);

// --- by hand

// Nearest to each other are a corner and a rim, or a tip: other directions part them too.
TEST(FrustumTouch, what_is_apart_at_a_corner_does_not_touch) {
  const Frustum cone{-0.3, 0.4, 0.6, 0};
  const Pair at_corner{"", {roller}, {Box{{0, 0, 0}, {1, 1, 1}}}};
  const double third = std::sqrt(1.0 / 3), half = std::sqrt(0.5);
  const Vector d{third, third, third}, u{half, -half, 0};
  const Vector radial = half * (d + u), axis = half * (d - u);
  const auto frame = [](const Vector& p, const Vector& x, const Vector& z) { return Frame{p, x, cross(z, x), z}; };
  for (const double gap : {0.01, 1e-4, 1e-8}) {
    EXPECT_TRUE(closed(at_corner, frame(-gap * d - 0.5 * axis - 0.1 * radial, radial, axis)).empty()) << gap;
    EXPECT_TRUE(closed({"", {cone}, at_corner.J}, frame(-(gap + 0.6) * d, u, d)).empty()) << gap;
    const Vector away{half, 0, half}, beside{0, 1, 0};
    EXPECT_TRUE(closed({"", {cone}, {roller}}, frame(Vector{0.1, 0, 0.5} + (gap + 0.6) * away, beside, -away)).empty())
        << gap;
  }
}

// By no more than rounding of how near they are: there is always an answer.
TEST(FrustumTouch, is_determined_where_it_begins) {
  for (const double depth : {1e-8, 1e-11, 1e-14, 1e-16, 0.0, -1e-16, -1e-12}) {
    const auto all_defined = [&](const Pair& p, const Frame& at) {
      for (const Touch<double>& t : touches(p, at)) EXPECT_TRUE(t.defined || !t.closed()) << depth;
    };
    const double r = 0.1 - depth, s = std::sqrt(0.5);
    all_defined({"", {roller}, {table}}, lying(0, {0.3, 2 + r * s, r * s}));
    all_defined({"", {roller}, {table}}, lying(0.3, {0.3, 0.2, r}));
    all_defined({"", {roller}, {drum}}, {{0.6 - depth, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    all_defined({"", {roller}, {drum}}, {{0.6 - depth, 0, 0}, {1, 0, 0}, {0, s, -s}, {0, s, s}});
  }
}

TEST(FrustumTouch, has_no_place_where_a_circle_is_as_near) {
  const auto undefined = [](const Pair& p, const Frame& at) {
    const auto list = closed(p, at);
    return !list.empty() && std::all_of(list.begin(), list.end(), [](const auto& t) { return !t.defined; });
  };
  const Frame within{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_TRUE(undefined({"", {roller}, {drum}}, within));
  EXPECT_TRUE(undefined({"", {Frustum{-1, 0.06, 1, 0.06}}, {Frustum{-0.05, 0.5, 0.05, 0.5}}}, within));
  // As near to parting one way as the other.
  const Matrix3 turned = rotation_exponential({0.3, 0.2, 0.1});
  EXPECT_TRUE(
      undefined({"", {roller}, {Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}}}, {{0, 0, 0}, turned.x, turned.y, turned.z}));
}

}  // namespace
}  // namespace dynalin::frustum_touch_test

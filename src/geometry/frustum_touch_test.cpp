#include "geometry/frustum_touch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "geometry/moved_frame_test_support.h"
#include "geometry/touch.h"

namespace dynalin::frustum_touch_test {
namespace {

using solid::Box;
using solid::Frustum;
using solid::Side;

struct Pair {
  std::string name;
  Side I, J;
};

void PrintTo(const Pair& p, std::ostream* out) { *out << p.name; }

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

using Frame = RelativeFrame<double>;

// How far all of a side reaches in a direction, in its own axes.
double reach(const Side& s, const Vector& n) {
  if (const auto* b = std::get_if<Box>(&s.shape)) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += std::max(n[k] * b->low[k], n[k] * b->high[k]);
    return sum;
  }
  const auto& f = std::get<Frustum>(s.shape);
  const double across = std::hypot(n.x, n.y);
  return std::max(f.low * n.z + f.low_radius * across, f.high * n.z + f.high_radius * across);
}
double separation(const Pair& p, const Frame& at, const Vector& n) {
  return dot(n, at.p) - reach(p.I, {-dot(n, at.x), -dot(n, at.y), -dot(n, at.z)}) - reach(p.J, n);
}

// The largest of all directions: by many of them, and steps that shrink from the best ones.
double largest_separation(const Pair& p, const Frame& at) {
  constexpr int rings = 60;
  std::vector<std::pair<double, Vector>> list;
  for (int i = 0; i < rings; ++i) {
    const double polar = M_PI * (i + 0.5) / rings;
    const int around = std::max(4, static_cast<int>(2 * rings * std::sin(polar)));
    for (int k = 0; k < around; ++k) {
      const double a = 2 * M_PI * k / around;
      const Vector n{std::sin(polar) * std::cos(a), std::sin(polar) * std::sin(a), std::cos(polar)};
      list.emplace_back(separation(p, at, n), n);
    }
  }
  // The sharp ones between them.
  for (int k = 0; k < 3; ++k) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector of_J = sign * unit_vectors[static_cast<std::size_t>(k)];
      const Vector of_I = sign * (k == 0 ? at.x : k == 1 ? at.y : at.z);
      list.emplace_back(separation(p, at, of_J), of_J), list.emplace_back(separation(p, at, of_I), of_I);
    }
  }
  std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::mt19937_64 random(11);
  std::normal_distribution<double> any;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t start = 0; start < 12; ++start) {
    auto [best, n] = list[start];
    for (double step = 0.05; step > 1e-9;) {
      bool better = false;
      for (int k = 0; k < 40 && !better; ++k) {
        const Vector to = n + step * Vector{any(random), any(random), any(random)};
        const Vector m = (1 / norm(to)) * to;
        if (const double h = separation(p, at, m); h > best) best = h, n = m, better = true;
      }
      if (!better) step *= 0.7;
    }
    most = std::max(most, best);
  }
  return most;
}

Frame placed(std::mt19937_64& random) {
  std::normal_distribution<double> any;
  const Matrix3 R = rotation_exponential({any(random), any(random), any(random)});
  return {{0.5 * any(random), 0.5 * any(random), 0.5 * any(random)}, R.x, R.y, R.z};
}
std::vector<Touch<double>> touches(const Pair& p, const Frame& at) {
  std::vector<Touch<double>> list(touch_count(p.I, p.J));
  find_touches<double>(p.I, p.J, at, list);
  return list;
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
  int apart = 0, together = 0;
  for (int draw = 0; draw < 50; ++draw) {
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
  EXPECT_GT(apart, 5);
  EXPECT_GT(together, 5);
}

// The gap grows by the motion along the normal; normal, point and share are those of differences.
TEST_P(FrustumTouch, duals_are_the_derivatives) {
  const Pair& p = GetParam();
  constexpr double h = 1e-5;
  std::mt19937_64 random(4);
  int compared = 0;
  for (int draw = 0; draw < 60; ++draw) {
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
  EXPECT_GT(compared, 30);
}

std::array<double, 6> resultant(const Pair& p, const Frame& at, bool defined = true) {
  std::array<double, 6> sum{};
  for (const Touch<double>& t : touches(p, at)) {
    if (!t.closed()) continue;
    EXPECT_EQ(t.defined, defined);
    const Vector F = (-t.gap * t.weight) * t.normal, M = cross(t.point, F);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += F[k], sum[3 + k] += M[k];
  }
  return sum;
}

TEST_P(FrustumTouch, exchanged_sides_push_each_other_with_opposite_forces) {
  const Pair& p = GetParam();
  std::mt19937_64 random(5);
  for (int draw = 0; draw < 60; ++draw) {
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

const Frustum roller{-0.5, 0.1, 0.5, 0.1}, drum{-1, 0.5, 1, 0.5};
const Box table{{-2, -2, -1}, {2, 2, 0}};

// z of the first along (cos, sin, 0) of an angle, its x up.
Frame lying(double angle, const Vector& p) {
  return {p, {0, 0, 1}, {std::sin(angle), -std::cos(angle), 0}, {std::cos(angle), std::sin(angle), 0}};
}
std::vector<Touch<double>> closed(const Pair& p, const Frame& at) {
  std::vector<Touch<double>> list = touches(p, at);
  std::erase_if(list, [](const Touch<double>& t) { return !t.closed() || t.weight == 0; });
  return list;
}
// One place where two lines cross, whatever their angle, with its whole force.
TEST(FrustumTouch, crossed_cylinders_meet_on_their_common_perpendicular) {
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
TEST(FrustumTouch, parallel_cylinders_meet_at_both_ends) {
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
TEST(FrustumTouch, ends_pass_into_a_crossing_by_a_cubic) {
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
TEST(FrustumTouch, parallel_lines_of_cones_meet_at_both_ends) {
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
TEST(FrustumTouch, coins_meet_where_their_rims_cross) {
  const Frustum coin{-0.05, 0.5, 0.05, 0.5};
  const double tilt = 0.005, s = std::sin(tilt), c = std::cos(tilt);
  const auto list = closed({"", {coin}, {coin}}, {{0.7, 0, 0.1 + 1e-3}, {1, 0, 0}, {0, c, -s}, {0, s, c}});
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].weight, 1);
  EXPECT_NEAR(list[0].point.x, 0.35, 1e-3);
  EXPECT_NEAR(list[0].point.y, std::sqrt(0.25 - 0.35 * 0.35), 1e-3);
  EXPECT_NEAR(list[0].gap, 1e-3 - tilt * list[0].point.y, 1e-5);
}

// A brick that slides flat over an end and out over its rim, at any angle: the outline of what both have in common
// turns once around, by right angles at corners of the brick in it, by other angles where edges pass over the rim, and
// along the rest of the rim. Each right angle has the force of one corner, and nothing jumps.
TEST(FrustumTouch, corners_that_leave_over_a_rim_hand_their_force_to_edges) {
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
TEST(FrustumTouch, rim_over_an_edge_meets_it_once) {
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

// The deepest point of a tilted cylinder below the end of another one, a little outside of its rim: there the rims meet
// in a direction that is hardly another than that of the end.
TEST(FrustumTouch, rims_meet_beside_the_direction_of_an_end) {
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
TEST(FrustumTouch, force_is_continuous_where_a_rim_passes_over_another_one) {
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

TEST(FrustumTouch, cylinder_lies_on_a_box_with_both_rims_or_the_edge_below_it) {
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

TEST(FrustumTouch, force_is_continuous_where_a_cylinder_leaves_over_an_edge) {
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

TEST(FrustumTouch, box_stands_on_an_end_with_its_corners) {
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

// In its middle where it is flat; on the circle from an inclination of a ten-thousandth on; and between them as the
// derivative of the depth says.
TEST(FrustumTouch, rim_that_stands_flat_bears_in_its_middle) {
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

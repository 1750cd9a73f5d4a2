#include "geometry/box_touch.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace dynalin::box_touch_test {
namespace {

using Axes = std::array<Vector, 3>;

Axes turned(const Vector& about, double angle) {
  const Vector n = (1 / norm(about)) * about;
  const auto turn = [&](const Vector& v) {
    return std::cos(angle) * v + std::sin(angle) * cross(n, v) + (1 - std::cos(angle)) * dot(n, v) * n;
  };
  return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1})};
}

// What a pressure of 1 per length makes of all places: force and torque about J's origin.
std::array<double, 6> resultant(const solid::Box& I, const Vector& p, const Axes& axes, const solid::Box& J) {
  std::array<Touch<double>, box_touches> touches;
  touch_boxes(I, RelativeFrame<double>{p, axes[0], axes[1], axes[2]}, J, std::span<Touch<double>>(touches));
  std::array<double, 6> sum{};
  for (const Touch<double>& t : touches) {
    if (!t.closed()) continue;
    EXPECT_TRUE(t.defined);
    const Vector F = (-t.gap * t.weight) * t.normal, M = cross(t.point, F);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += F[k], sum[3 + k] += M[k];
  }
  return sum;
}
double difference(const std::array<double, 6>& a, const std::array<double, 6>& b) {
  double most = 0;
  for (std::size_t k = 0; k < 6; ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

const solid::Box cube{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, table{{-2, -2, -1}, {2, 2, 0}};

TEST(BoxTouch, smaller_box_stands_on_its_corners) {
  const auto sum = resultant(cube, {0.3, 0.2, 0.49}, turned({0, 0, 1}, 0.4), table);
  EXPECT_NEAR(sum[2], 4 * 0.01, 1e-15);
  EXPECT_NEAR(sum[3], 0.2 * sum[2], 1e-15);
  EXPECT_NEAR(sum[4], -0.3 * sum[2], 1e-15);
}

// However the upper one of two equal boxes is turned about the vertical: on its corners where it is flush, on up to
// eight crossings of edges otherwise.
TEST(BoxTouch, equal_boxes_hold_each_other_alike_at_every_angle) {
  for (const double angle : {0.0, 1e-13, 1e-7, 1e-3, 0.3, 0.7853981633974483, 1.2, 1.5707963267948966}) {
    const auto sum = resultant(cube, {0, 0, 0.99}, turned({0, 0, 1}, angle), cube);
    EXPECT_NEAR(sum[2], 4 * 0.01, 1e-12) << angle;
    for (const std::size_t k : {0u, 1u, 3u, 4u, 5u}) EXPECT_NEAR(sum[k], 0, 1e-9) << angle;
  }
}

TEST(BoxTouch, force_and_torque_are_continuous_where_a_corner_passes_over_an_edge) {
  constexpr double step = 1e-8;
  for (const double angle : {0.0, 0.1, 0.6, -0.3}) {
    const Axes axes = turned({0, 0, 1}, angle);
    // The corner farthest in x, on the edge x = 2 of the table.
    double reach = 0;
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) reach = std::max(reach, x * axes[0].x + y * axes[1].x);
    }
    const auto at = [&](double off) { return resultant(cube, {2 - reach + off, 0.3, 0.48}, axes, table); };
    EXPECT_LE(difference(at(-step), at(step)), 10 * step) << angle;
    EXPECT_LE(difference(at(-step), at(0)), 10 * step) << angle;
    EXPECT_GT(at(0)[2], 0.07);
  }
  // Tilted by little: the normals of faces and of crossings differ by that.
  const Axes tilted = turned({0.3, 0.1, 1}, 0.02);
  const auto at = [&](double off) { return resultant(cube, {1.5 + off, 0.3, 0.48}, tilted, table); };
  auto before = at(-0.03);
  for (double off = -0.03; off < 0.03; off += 1e-5) {
    const auto now = at(off);
    EXPECT_LE(difference(before, now), 2e-4) << off;
    before = now;
  }
}

TEST(BoxTouch, edge_on_edge_is_the_common_perpendicular) {
  // An edge of the lower one along x at the height 0, one of the upper one at an angle to it in the plane above.
  const double s = std::sqrt(0.5);
  const solid::Box bar{{-3, -0.5, -0.5}, {3, 0.5, 0.5}};
  const Axes lower = turned({1, 0, 0}, 0.7853981633974483);
  for (const double angle : {1.5707963267948966, 1.0, 0.7, 0.1, 0.01}) {
    // The upper one, turned about its own x by 45 degrees and then about the vertical, seen from the lower one.
    const Axes about = turned({0, 0, 1}, angle);
    Axes axes;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector global = about[0] * lower[k].x + about[1] * lower[k].y + about[2] * lower[k].z;
      axes[k] = {dot(global, lower[0]), dot(global, lower[1]), dot(global, lower[2])};
    }
    const Vector up{lower[0].z, lower[1].z, lower[2].z};
    const auto sum = resultant(bar, (2 * s - 0.01) * up, axes, bar);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(sum[k], 0.01 * up[k], 1e-14) << angle;
      EXPECT_NEAR(sum[3 + k], 0, 1e-14) << angle;
    }
  }
}

TEST(BoxTouch, exchanged_boxes_push_each_other_with_opposite_forces) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  int touching = 0;
  for (int draw = 0; draw < 400; ++draw) {
    const Axes axes = turned({any(random), any(random), any(random)}, 3 * any(random));
    const Vector p{0.9 * any(random), 0.9 * any(random), 0.9 * any(random)};
    const auto sum = resultant(cube, p, axes, cube);
    const Axes back{
        Vector{axes[0].x, axes[1].x, axes[2].x}, {axes[0].y, axes[1].y, axes[2].y}, {axes[0].z, axes[1].z, axes[2].z}};
    const Vector q = -(p.x * back[0] + p.y * back[1] + p.z * back[2]);
    const auto other = resultant(cube, q, back, cube);
    const Vector F = other[0] * axes[0] + other[1] * axes[1] + other[2] * axes[2];
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], -F[k], 1e-12) << draw;
    touching += norm(F) > 0;
  }
  EXPECT_GT(touching, 200);
}

// Differences of the places themselves, between which nothing switches.
TEST(BoxTouch, duals_are_the_derivatives) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  int compared = 0;
  for (int draw = 0; draw < 100; ++draw) {
    const Axes axes = turned({any(random), any(random), any(random)}, 3 * any(random));
    const Vector p{0.7 * any(random), 0.7 * any(random), 0.7 * any(random)};
    const Vector move{any(random), any(random), any(random)}, turn{any(random), any(random), any(random)};
    const auto frame = [&](double t) {
      RelativeFrame<double> f{p + t * move, axes[0], axes[1], axes[2]};
      const double angle = t * norm(turn);
      if (t != 0) {
        const Axes R = turned(turn, angle);
        const auto rotate = [&](const Vector& v) { return v.x * R[0] + v.y * R[1] + v.z * R[2]; };
        f.x = rotate(f.x), f.y = rotate(f.y), f.z = rotate(f.z);
      }
      return f;
    };
    const auto seeded = [&](const Vector& v, const Vector& rate) {
      Vec3<Dual<12>> s{Dual<12>(v.x), Dual<12>(v.y), Dual<12>(v.z)};
      s.x.partial[0] = rate.x, s.y.partial[0] = rate.y, s.z.partial[0] = rate.z;
      return s;
    };
    const RelativeFrame<Dual<12>> dual{seeded(p, move), seeded(axes[0], cross(turn, axes[0])),
                                       seeded(axes[1], cross(turn, axes[1])), seeded(axes[2], cross(turn, axes[2]))};
    std::array<Touch<Dual<12>>, box_touches> exact;
    touch_boxes(cube, dual, cube, std::span<Touch<Dual<12>>>(exact));
    constexpr double h = 1e-5;
    std::array<Touch<double>, box_touches> before, after;
    touch_boxes(cube, frame(-h), cube, std::span<Touch<double>>(before));
    touch_boxes(cube, frame(h), cube, std::span<Touch<double>>(after));
    for (std::size_t k = 0; k < box_touches; ++k) {
      if (!exact[k].closed() || !before[k].closed() || !after[k].closed()) continue;
      if (norm(after[k].normal - before[k].normal) > 0.01) continue;  // another face
      ++compared;
      const auto expect = [&](double a, double b, const Dual<12>& of) {
        EXPECT_NEAR((b - a) / (2 * h), of.partial[0], 1e-5 * (1 + std::abs(of.partial[0]))) << draw << ' ' << k;
      };
      expect(before[k].gap, after[k].gap, exact[k].gap);
      expect(before[k].weight, after[k].weight, exact[k].weight);
      for (std::size_t c = 0; c < 3; ++c) {
        expect(before[k].normal[c], after[k].normal[c], exact[k].normal[c]);
        expect(before[k].point[c], after[k].point[c], exact[k].point[c]);
      }
    }
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace dynalin::box_touch_test

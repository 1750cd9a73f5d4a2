#include "geometry/ellipsoid_touch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/moved_frame_test_support.h"
#include "geometry/touch.h"
#include "mechanics/path.h"

namespace dynalin::ellipsoid_touch_test {
namespace {

using solid::Box;
using solid::Ellipsoid;
using solid::Frustum;
using solid::Side;

using Frame = RelativeFrame<double>;

// Ellipsoids as thin as coins or needles in box, cylinder and frustum, up to almost through them.
struct Draw {
  Ellipsoid ellipsoid;
  Side solid;
  Frame at;
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Draw draw() {
    Vector axes{between(0.4, 0.8), between(0.4, 0.8), between(0.4, 0.8)};
    axes[std::uniform_int_distribution<std::size_t>(0, 2)(engine_)] = between(0.07, 0.18);
    const Matrix3 R = rotation_exponential({between(-3, 3), between(-3, 3), between(-3, 3)});
    return {{axes}, {solid()}, {{between(-1, 1), between(-1, 1), between(-1, 1)}, R.x, R.y, R.z}};
  }

 private:
  std::variant<Frustum, Box> shape() {
    const double radius = between(0.2, 0.6), height = between(0.4, 1);
    switch (std::uniform_int_distribution<int>(0, 2)(engine_)) {
      case 0:
        return Frustum{0, radius, height, radius};
      case 1:
        return Frustum{0, radius, height, between(0.1, 0.5)};
      default:
        return Box{{0, 0, 0}, {between(0.3, 0.9), between(0.3, 0.9), between(0.3, 0.9)}};
    }
  }
  Side solid() {
    return std::visit([](const auto& s) { return Side{s}; }, shape());
  }

  std::mt19937_64 engine_;
};

double reach(const Side& s, const Vector& n) {
  if (const auto* b = std::get_if<Box>(&s.shape)) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += n[k] * (n[k] > 0 ? b->high[k] : b->low[k]);
    return sum;
  }
  const auto& f = std::get<Frustum>(s.shape);
  const double across = std::hypot(n.x, n.y);
  return std::max(f.low * n.z + f.low_radius * across, f.high * n.z + f.high_radius * across);
}
double separation(const Draw& d, const Vector& n) {
  const Vector a = d.ellipsoid.semi_axes;
  return dot(n, d.at.p) - reach(d.solid, n) -
         norm(Vector{a.x * dot(d.at.x, n), a.y * dot(d.at.y, n), a.z * dot(d.at.z, n)});
}

template <class T>
Touch<T> touched(const Draw& d, const RelativeFrame<T>& at) {
  std::array<Touch<T>, 1> list;
  find_touches<T>(Side{d.ellipsoid}, d.solid, at, list);
  return list[0];
}

// The normal is a direction along which they are as far apart as it says, and there is none with more.
TEST(EllipsoidTouch, is_along_the_direction_of_the_largest_separation) {
  Random random(3);
  int together = 0, deep = 0, aslant = 0;
  for (int draw = 0; draw < 3000; ++draw) {
    const Draw d = random.draw();
    const Touch<double> t = touched(d, d.at);
    const Vector a = d.ellipsoid.semi_axes;
    const double least_axis = std::min({a.x, a.y, a.z});
    if (!(t.gap > -0.7 * least_axis)) continue;
    ASSERT_TRUE(t.defined) << draw;
    EXPECT_NEAR(norm(t.normal), 1, 1e-12);
    EXPECT_NEAR(separation(d, t.normal), t.gap, 1e-9) << draw;
    const bool touch = t.gap <= 0;
    if (touch) {
      ++together, deep += t.gap < -0.3 * least_axis;
      aslant += std::max({std::abs(t.normal.x), std::abs(t.normal.y), std::abs(t.normal.z)}) < 0.99;
    }
    for (int k = 0; k < (touch ? 400 : 40); ++k) {
      const Vector any{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
      const Vector n = k % 2 == 0 ? any : t.normal + any * std::pow(0.5, k / 10);
      EXPECT_LE(separation(d, n / norm(n)), t.gap + 1e-9) << draw;
    }
  }
  EXPECT_GT(together, 200);
  EXPECT_GT(deep, 120);
  EXPECT_GT(aslant, 150);
}

// An edge through the middle of a disc: the point of the edge from which the way out is longest, or shortest, has no
// way across the edge. Depth and direction are those of a search over all directions.
TEST(EllipsoidTouch, is_found_where_an_edge_goes_through_a_disc) {
  const auto turn = [](double degrees, std::size_t axis) {
    return rotation_exponential(degrees * std::numbers::pi / 180 * unit_vectors[axis]);
  };
  const Matrix3 R = turn(66.8, 2) * turn(104.2, 0) * turn(-112, 2);
  const Draw d{
      {{0.7445, 0.5775, 0.128}}, {Box{{0, -0.778, 0}, {0.369, 0, 0.468}}}, {{-0.0668, 0.0657, -0.6535}, R.x, R.y, R.z}};
  const Touch<double> t = touched(d, d.at);
  ASSERT_TRUE(t.defined);
  EXPECT_NEAR(t.gap, -0.036904, 1e-6);
  EXPECT_LT(norm(t.normal - Vector{0, 0.2368, -0.9716}), 2e-3);
}

TEST(EllipsoidTouch, has_the_derivatives_of_differences) {
  constexpr double h = 1e-6;
  Random random(4);
  int compared = 0;
  for (int draw = 0; draw < 1200; ++draw) {
    const Draw d = random.draw();
    const Touch<double> here = touched(d, d.at);
    const Vector a = d.ellipsoid.semi_axes;
    if (!here.defined || here.gap > 0 || here.gap < -0.7 * std::min({a.x, a.y, a.z})) continue;
    const auto along = [](const Vector& v) { return Vec3<Taylor>{Taylor(v.x), Taylor(v.y), Taylor(v.z)}; };
    const auto seeds = path::seeded<12>({along(d.at.p), along(d.at.x), along(d.at.y), along(d.at.z)});
    const auto values = [](const auto& v) { return Vec3<Dual<12>>{v.x.value, v.y.value, v.z.value}; };
    const auto exact = touched<Dual<12>>(d, {values(seeds.p), values(seeds.x), values(seeds.y), values(seeds.z)});
    for (std::size_t c = 0; c < 6; ++c) {
      const auto after = touched(d, moved(d.at, c, h)), before = touched(d, moved(d.at, c, -h));
      if (norm(after.point - before.point) > 1e-3) continue;  // another place
      ++compared;
      const Vector turn = cross(here.point - d.at.p, here.normal);
      EXPECT_NEAR(exact.gap.partial[c], c < 3 ? here.normal[c] : turn[c - 3], 1e-8) << draw;
      for (std::size_t x = 0; x < 3; ++x) {
        const auto expect = [&](double from, double to, const Dual<12>& of) {
          EXPECT_NEAR((to - from) / (2 * h), of.partial[c], 1e-4 * (1 + std::abs(of.partial[c]))) << draw;
        };
        expect(before.normal[x], after.normal[x], exact.normal[x]);
        expect(before.point[x], after.point[x], exact.point[x]);
      }
    }
  }
  EXPECT_GT(compared, 400);
}

}  // namespace
}  // namespace dynalin::ellipsoid_touch_test

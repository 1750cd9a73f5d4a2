// Seeds of path variations against differences of varied relative motions.
#include "mechanics/path.h"

#include <gtest/gtest.h>

#include "mechanics/pair.h"
#include "mechanics/paths_test_support.h"

namespace dynalin::mechanics_test::path_test {
namespace {

constexpr MarkerId I{2}, J{5};

// I as seen from J along a path, moved and turned by δξ t^level / level! in the axes of J.
struct Seen {
  RealVector p;
  RealMatrix axes;
};
Seen seen(const Moment& m, std::size_t seed = 0, Real size = 0) {
  Seen s{transpose_times(m.axes(J), m.origin(I) - m.origin(J)), transpose_times(m.axes(J), m.axes(I))};
  const Variation v{0, seed / 6, size};
  RealVector e{};
  e[seed % 3] = v.at(m.t);
  if (seed % 6 < 3) {
    s.p += e;
  } else {
    s.axes = turn(e) * s.axes;
  }
  return s;
}

// Any scalar of a relative frame.
template <class T>
T scalar(const Vec3<T>& p, const Vec3<T>& x, const Vec3<T>& y, const Vec3<T>& z) {
  return p.x * x.y + p.y * y.z * z.x + p.z * p.x * z.y - dot(p, y) * x.x;
}
Real scalar(const Seen& s) { return scalar(s.p, s.axes.x, s.axes.y, s.axes.z); }

TEST(PathVariations, seeds_of_a_relative_frame_carry_displacements_and_turns_at_two_levels) {
  const Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  const auto f = path::seeded<12>(pair.relative);
  const auto s = scalar(f.p, f.x, f.y, f.z);
  for (std::size_t seed = 0; seed < 12; ++seed) {
    const auto gradient = [&](const Moment& m) {
      return slope([&](Real size) { return scalar(seen(m, seed, size)); });
    };
    EXPECT_TRUE(agree(s.value.partial[seed], gradient(p.now()))) << "seed " << seed;
    EXPECT_TRUE(agree(s.rate.partial[seed], p.now().rate(gradient))) << "rate of seed " << seed;
    EXPECT_TRUE(agree(s.acceleration.partial[seed], p.now().second_rate(gradient))) << "second rate of seed " << seed;
  }
  const auto plain = [](const Moment& m) { return scalar(seen(m)); };
  EXPECT_TRUE(agree(s.value.value, plain(p.now())));
  EXPECT_TRUE(agree(s.rate.value, p.now().rate(plain)));
  EXPECT_TRUE(agree(s.acceleration.value, p.now().second_rate(plain)));
}

TEST(PathVariations, a_variation_of_second_order_is_the_acceleration_it_adds) {
  Vec3<TimeTaylor<Dual<3>>> v = path::constant<3>(Vec3<Taylor>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
  const Vec3<Taylor> d{{0.5, 0.25, 2}, {-1, 3, 4}, {2, 7, -5}};
  for (std::size_t level = 0; level < 3; ++level) path::vary(v, level, level, d);
  for (std::size_t k = 0; k < 3; ++k) {
    // d(t) t^l / l! and its derivatives at 0
    EXPECT_EQ(v[k].value.partial, (std::array<double, 3>{d[k].value, 0, 0}));
    EXPECT_EQ(v[k].rate.partial, (std::array<double, 3>{d[k].rate, d[k].value, 0}));
    EXPECT_EQ(v[k].acceleration.partial, (std::array<double, 3>{d[k].acceleration, 2 * d[k].rate, d[k].value}));
  }
  EXPECT_EQ(v.y.rate.value, 5);
}

TEST(PathVariations, gradients_of_gradients_are_taken_at_the_pose_that_is_varied_first) {
  const Paths p;
  const PairMotion pair = pair_motion(p.motion, p.layout.marker(I), p.layout.marker(J));
  const auto f = path::nested(pair.relative);
  const auto s = scalar(f.p, f.x, f.y, f.z);
  const Seen at = seen(p.now());
  const auto moved = [](Seen from, std::size_t seed, Real size) {
    RealVector e{};
    e[seed % 3] = size;
    if (seed < 3) {
      from.p += e;
    } else {
      from.axes = turn(e) * from.axes;
    }
    return from;
  };
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      const Real expected = slope(
          [&](Real outer) { return slope([&](Real inner) { return scalar(moved(moved(at, k, outer), i, inner)); }); });
      EXPECT_TRUE(agree(s.partial[i].partial[k], expected)) << "gradient " << i << " varied by " << k;
    }
    EXPECT_TRUE(agree(s.partial[i].value, slope([&](Real inner) { return scalar(moved(at, i, inner)); })));
    EXPECT_TRUE(agree(s.value.partial[i], s.partial[i].value));
  }
}

}  // namespace
}  // namespace dynalin::mechanics_test::path_test

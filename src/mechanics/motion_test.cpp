// Motions of bodies and markers against differences of paths in time.
#include "mechanics/motion.h"

#include <gtest/gtest.h>

#include <numbers>

#include "mechanics/paths_test_support.h"

namespace dynalin::mechanics_test::motion_test {
namespace {

void expect_near(const Vector& value, const RealVector& expected, const char* what) {
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_TRUE(agree(value[k], expected[k])) << what << " "
                                              << "xyz"[k];
}

TEST(Motion, rates_of_axes_follow_from_angular_velocity_and_acceleration) {
  const Paths p;
  for (std::int32_t b = 0; b < 5; ++b) {
    const BodyMotion& m = p.motion.bodies[static_cast<std::size_t>(b)];
    for (std::size_t c = 0; c < 3; ++c) {
      const auto axis = [&](const Moment& at) { return at.axes_of(BodyId{b})[c]; };
      expect_near(m.R[c], axis(p.now()), "axis");
      expect_near(m.Rdot[c], p.now().rate(axis), "its rate");
      expect_near(m.Rddot[c], p.now().second_rate(axis), "its second rate");
    }
  }
}

TEST(Motion, marker_frames_move_with_their_body_and_turn_with_it) {
  const Paths p;
  for (std::int32_t k = 0; k < 10; ++k) {
    const MarkerId m{k};
    const Frame<Taylor> f = p.motion.frame(p.marker(k));
    const auto origin = [&](const Moment& at) { return at.origin(m); };
    expect_near(value(f.origin), origin(p.now()), "origin");
    expect_near(rate(f.origin), p.now().rate(origin), "velocity");
    expect_near(acceleration(f.origin), p.now().second_rate(origin), "acceleration");
    expect_near(p.motion.point(p.marker(k)), origin(p.now()), "point");
    const auto arm = [&](const Moment& at) { return at.arm(m); };
    expect_near(value(p.motion.arm(p.marker(k))), arm(p.now()), "arm");
    expect_near(rate(p.motion.arm(p.marker(k))), p.now().rate(arm), "rate of the arm");
    expect_near(acceleration(p.motion.arm(p.marker(k))), p.now().second_rate(arm), "second rate of the arm");
    for (std::size_t c = 0; c < 3; ++c) {
      const auto axis = [&](const Moment& at) { return at.axes(m)[c]; };
      expect_near(p.motion.axes(p.marker(k))[c], axis(p.now()), "axis");
      expect_near(value(f.axes[c]), axis(p.now()), "axis along the motion");
      expect_near(rate(f.axes[c]), p.now().rate(axis), "rate of the axis");
      expect_near(acceleration(f.axes[c]), p.now().second_rate(axis), "second rate of the axis");
    }
  }
}

TEST(Motion, origins_counted_from_another_body_are_exact_far_from_the_global_origin) {
  Paths p;
  const Vector far{1e12, -3e11, 7e12};
  const BodyId from{1};
  const auto from_body = [&](const Moment& at) { return at.origin(MarkerId{4}) - at.origin_of(from); };
  const Frame<Taylor> near = p.motion.frame(p.marker(4), from);
  expect_near(value(near.origin), from_body(p.now()), "origin");
  expect_near(rate(near.origin), p.now().rate(from_body), "velocity");
  expect_near(acceleration(near.origin), p.now().second_rate(from_body), "acceleration");
  for (BodyMotion& b : p.motion.bodies) b.r = far;
  const Frame<Taylor> away = p.motion.frame(p.marker(4), from);
  const Vector arm = value(p.motion.arm(p.marker(4)));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(value(away.origin)[k], arm[k]);
}

TEST(Motion, an_angle_is_unwrapped_to_the_turn_that_is_remembered) {
  constexpr double turn = 2 * std::numbers::pi;
  EXPECT_NEAR(unwrapped(0.3, 3 * turn + 0.1), 3 * turn + 0.3, 1e-14);
  EXPECT_NEAR(unwrapped(-3.1, 3.1), turn - 3.1, 1e-14);
  EXPECT_NEAR(unwrapped(3.1, -3.1), 3.1 - turn, 1e-14);
  EXPECT_EQ(unwrapped(0.3, 0.0), 0.3);
}

}  // namespace
}  // namespace dynalin::mechanics_test::motion_test

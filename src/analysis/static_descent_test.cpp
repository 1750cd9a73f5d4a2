// The search that goes downhill, alone.
#include "analysis/static_descent.h"

#include <gtest/gtest.h>

#include <numbers>

#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::static_descent_test {
namespace {

TEST(StaticDescent, goes_down_and_not_to_the_unstable_rest_nearby) {
  for (const double angle : {0.4, 1.7, 3.1, -3.1}) {
    Search s(pendulum(angle));
    Descent d(s.equations, s.options, s.history);
    ASSERT_TRUE(d.run(s.op)) << "from " << angle;
    EXPECT_NEAR(angle_of(s.op), 0, 1e-12) << "from " << angle;
    EXPECT_LE(s.imbalance(), 1e-12);
  }
}

TEST(StaticDescent, a_point_at_rest_is_left_as_it_is_stable_or_not) {
  Search s(gravity + "PART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20, QP=0,1,0\nMARKER/21\nJOINT/1, REVOLUTE, I=21, J=1\n");
  Descent d(s.equations, s.options, s.history);
  EXPECT_TRUE(d.run(s.op));
  EXPECT_EQ(angle_of(s.op), 0);
  EXPECT_EQ(s.history.iterations(), 1);
}

// 20 sin φ = T at rest, and downhill from 0 is the lower of both angles.
TEST(StaticDescent, a_constant_torque_is_balanced_by_the_weight) {
  for (const double torque : {5.0, -12.0, 19.9}) {
    Search s(pendulum(0) + "SFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION=" + std::to_string(torque) + "\n");
    Descent d(s.equations, s.options, s.history);
    ASSERT_TRUE(d.run(s.op));
    EXPECT_NEAR(angle_of(s.op), std::asin(torque / 20), 1e-8);
  }
}

TEST(StaticDescent, a_torque_beyond_the_weight_finds_no_rest) {
  Search s(pendulum(0) + "SFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION=21\n");
  Descent d(s.equations, s.options, s.history);
  EXPECT_FALSE(d.run(s.op));
}

TEST(StaticDescent, a_force_without_potential_drives_it_in_circles) {
  Search s(swirl());
  Descent d(s.equations, s.options, s.history);
  EXPECT_FALSE(d.run(s.op));
}

TEST(StaticDescent, a_state_that_nothing_determines_is_held) {
  Search s(pendulum(0.5) + "DIFF/7, IC=4, FUNCTION=AZ(21,1)\n");
  Descent d(s.equations, s.options, s.history);
  ASSERT_TRUE(d.run(s.op));
  EXPECT_TRUE(d.held_states());
  EXPECT_NEAR(angle_of(s.op), 0, 1e-12);
}

TEST(StaticDescent, a_state_marked_as_held_keeps_its_value) {
  Search s(pendulum(0.5) + "DIFF/7, STATIC_HOLD, IC=4, FUNCTION=2+AZ(21,1)\n");
  Descent d(s.equations, s.options, s.history);
  ASSERT_TRUE(d.run(s.op));
  EXPECT_EQ(s.op.state[0], 4);
}

TEST(StaticDescent, what_a_force_no_longer_holds_as_it_faded_is_not_at_rest) {
  Search s(
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=EXP(-DZ(20,1))\n");
  const FirstFreedoms loose = freedoms_at(s.equations, s.op);
  s.op.poses[1].r.z = 1000;
  Descent d(s.equations, s.options, s.history);
  EXPECT_FALSE(d.polish(s.op, loose));
}

TEST(StaticDescent, what_is_a_million_lengths_away_has_escaped) {
  const auto system = system_of("POINT_MASS/2, MASS=1, CM=20, QG=3,4,0\nMARKER/20, POINT_MASS=2\n");
  const OperatingPoint from = system->drawn();
  OperatingPoint to = from;
  to.poses[1].r.z = 4e6;
  EXPECT_FALSE(escaped(*system, from, to));
  to.poses[1].r.z = 6e6;
  EXPECT_TRUE(escaped(*system, from, to));
  to.poses[1].r.z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(escaped(*system, from, to));
}

}  // namespace
}  // namespace dynalin::analysis_test::static_descent_test

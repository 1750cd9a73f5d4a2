// The least-squares search, alone.
#include "analysis/levenberg_marquardt.h"

#include <gtest/gtest.h>

#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::levenberg_marquardt_test {
namespace {

TEST(LevenbergMarquardt, finds_the_centre_round_which_a_motion_would_circle) {
  Search s(swirl());
  ASSERT_TRUE(reduce_imbalance(s.equations, s.op, 100));
  EXPECT_NEAR(s.op.poses[1].r.x, 0.2, 1e-5);
  EXPECT_NEAR(s.op.poses[1].r.y, -0.1, 1e-5);
  EXPECT_NEAR(s.op.poses[1].r.z, 0, 1e-5);
}

TEST(LevenbergMarquardt, keeps_constraints_on_its_way) {
  Search s(pendulum(1.2) + "SFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION=12\n");
  ASSERT_TRUE(reduce_imbalance(s.equations, s.op, 100));
  EXPECT_NEAR(angle_of(s.op), std::asin(0.6), 1e-5);
  EXPECT_NEAR(norm(s.op.poses[1].r), 0, 1e-12);
}

TEST(LevenbergMarquardt, ends_where_the_imbalance_is_least_and_says_that_it_is_not_zero) {
  Search s(fold);
  EXPECT_FALSE(reduce_imbalance(s.equations, s.op, 100));
  EXPECT_NEAR(s.op.state[0], 1, 1e-2);
}

// A torque on a wheel that is 0.5 where it begins to be 1: steps of 0.5 rad come to that place from 2.6 by way of 1.1.
TEST(LevenbergMarquardt, climbs_over_a_jump_where_it_may) {
  const std::string wheel =
      "PART/2, MASS=1, CM=20, IP=1,1,1, REULER=2.6,0,0\nMARKER/20\nJOINT/1, REVOLUTE, I=20, J=1\n"
      "SFORCE/1, ROTATIONAL, I=20, J=1, FUNCTION=IF(AZ(20,1)-1: -AZ(20,1), -AZ(20,1), 0.6-AZ(20,1))\n";
  Search falls(wheel), climbs(wheel);
  EXPECT_FALSE(reduce_imbalance(falls.equations, falls.op, 100, StepsMay::fall));
  EXPECT_NEAR(angle_of(falls.op), 1, 1e-2);
  EXPECT_TRUE(reduce_imbalance(climbs.equations, climbs.op, 100, StepsMay::climb));
  EXPECT_NEAR(angle_of(climbs.op), 0, 1e-5);
}

TEST(LevenbergMarquardt, every_step_brings_it_closer) {
  Search s(swirl());
  double before = s.imbalance();
  for (int k = 0; k < 5; ++k) {
    reduce_imbalance(s.equations, s.op, 1);
    s.equations.evaluate(s.op, Partials::yes);
    const double now = std::sqrt(s.equations.merit(1.0));
    if (k > 0) {
      EXPECT_LE(now, before * (1 + 1e-12));
    }
    before = now;
  }
}

}  // namespace
}  // namespace dynalin::analysis_test::levenberg_marquardt_test

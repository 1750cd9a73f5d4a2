#include "analysis/damped_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::damped_motion_test {
namespace {

bool relaxes(Search& s, const DampedMotion& motion = {}) {
  const FirstFreedoms loose = freedoms_at(s.equations, s.op);
  return relax_by_motion(s.equations, s.op, motion, s.history, 1e10, [&](OperatingPoint& here) {
    return Descent(s.equations, s.options, s.history).polish(here, loose);
  });
}

TEST(DampedMotion, a_pendulum_swings_down_and_hangs) {
  Search s(pendulum(2.8));
  ASSERT_TRUE(relaxes(s));
  EXPECT_NEAR(angle_of(s.op), 0, 1e-12);
  EXPECT_LT(s.imbalance(), 1e-12);
}

// Depth p of a mass of 2 under 10 in a contact: 1E6 p^1.5 = 20.
TEST(DampedMotion, ends_where_all_forces_balance_from_far_beyond_a_stop) {
  Search s(
      "ACCGRAV/KGRAV=-10\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0,-3\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=IMPACT(DZ(20,1),VZ(20,1),0,1E6,1.5,100,1E-3)\n");
  ASSERT_TRUE(relaxes(s));
  EXPECT_NEAR(s.op.poses[1].r.z, -std::pow(20 / 1e6, 1 / 1.5), 1e-12);
}

TEST(DampedMotion, takes_no_force_that_fades_for_rest) {
  Search s(
      "PART/2, MASS=1, CM=20, IP=1,1,1, QG=0,0,1\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
      "SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=EXP(-DZ(20,1))\n");
  EXPECT_FALSE(relaxes(s));
}

TEST(DampedMotion, ends_in_the_time_that_it_has) {
  Search s(pendulum(2.8));
  DampedMotion brief;
  brief.longest_time = 1e-6;
  EXPECT_FALSE(relaxes(s, brief));
}

// In a time that it is given, what is damped more has come down less far.
TEST(DampedMotion, is_slowed_by_global_damping) {
  const auto fallen = [](double damping) {
    Search s(pendulum(2.8));
    DampedMotion motion;
    motion.global_damping = damping, motion.longest_time = 0.1;
    EXPECT_FALSE(relaxes(s, motion));
    return 2.8 - std::abs(angle_of(s.op));
  };
  const double freely = fallen(0), damped = fallen(1e3);
  EXPECT_GT(damped, 0);
  EXPECT_GT(freely, 2 * damped);
}

TEST(DampedMotion, does_not_settle_what_falls_for_ever) {
  Search s(gravity + "PART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n");
  EXPECT_FALSE(relaxes(s));
}

}  // namespace
}  // namespace dynalin::analysis_test::damped_motion_test

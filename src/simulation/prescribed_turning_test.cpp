// How long a step may be before a MOTION turns too far in it.
#include "simulation/prescribed_turning.h"

#include <gtest/gtest.h>

#include <cmath>

#include "system/model_test_support.h"

namespace dynalin::simulation_test::prescribed_turning_test {
namespace {

using system_test::system_of;

constexpr double most = 1;  // [rad]

double step_of(const std::string& motion, double from = 0) {
  const auto system = system_of("PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, " + motion + "\n");
  OperatingPoint op = system->drawn();
  op.time = from;
  return PrescribedTurning(*system).step(op, 1, most);
}
std::string wheel(const std::string& motion) { return "REVOLUTE, I=20, J=1\nMOTION/1, JOINT=1, " + motion; }

TEST(PrescribedTurning, slow_and_small_ones_take_the_longest_step) {
  EXPECT_EQ(step_of(wheel("FUNCTION=0.9*TIME")), 1);
  EXPECT_EQ(step_of(wheel("VELOCITY, FUNCTION=0.9")), 1);
  EXPECT_EQ(step_of(wheel("FUNCTION=STEP(TIME,0.3,0,0.301,0.9)")), 1);
}

TEST(PrescribedTurning, one_that_is_over_soon_is_seen_by_where_it_ends) {
  for (const char* motion : {"FUNCTION=STEP(TIME,0.3,0,0.301,720D)", "FUNCTION=STEP(TIME,0.3,0,0.3001,-720D)",
                             "VELOCITY, FUNCTION=IF(TIME-0.3:0,0,IF(TIME-0.301:720D/0.001,0,0))"}) {
    const double h = step_of(wheel(motion));
    EXPECT_GT(h, 0.3) << motion;
    EXPECT_LT(h, 0.301) << motion;
  }
}

// What makes the step says what a jump is.
TEST(PrescribedTurning, jumps_are_no_turning) {
  EXPECT_EQ(step_of(wheel("FUNCTION=IF(TIME-0.3:0,5,5)")), 1);
  EXPECT_EQ(step_of(wheel("FUNCTION=IF(TIME-0.3:0,5,5)"), 0.3), 1);
  EXPECT_EQ(step_of(wheel("FUNCTION=IF(TIME-0.3:0,5,5)+IF(TIME-0.6:0,5,5)")), 1);
  const double h = step_of(wheel("FUNCTION=IF(TIME-0.3:0,5,5)+STEP(TIME,0.6,0,0.601,720D)"));
  EXPECT_GT(h, 0.6);
  EXPECT_LT(h, 0.601);
}

TEST(PrescribedTurning, translations_are_none) {
  EXPECT_EQ(step_of("TRANSLATIONAL, I=20, J=1\nMOTION/1, JOINT=1, FUNCTION=100*TIME"), 1);
  EXPECT_EQ(step_of("REVOLUTE, I=20, J=1\nMOTION/1, JOINT=1, FUNCTION=SQRT(TIME-2)"), 1);  // no value either
}

}  // namespace
}  // namespace dynalin::simulation_test::prescribed_turning_test

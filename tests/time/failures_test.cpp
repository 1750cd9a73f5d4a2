// A run that cannot go on ends, says when and why, and keeps what it had until then.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "time/course.h"

namespace dynalin::in_time::failures_test {
namespace {

using ::testing::HasSubstr;

const std::string slider = R"(t
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1, QG=0,0,1
MARKER/2, PART=2
JOINT/1, TRANSLATIONAL, I=2, J=1
VARIABLE/1, FUNCTION=DZ(2,1)
)";

TEST(Failures, a_state_that_goes_to_infinity_is_named_with_its_time) {
  const Course c = led_through_time(
      "t\nPART/1, GROUND\nDIFF/7, FUNCTION=DIF(7)**2, IC=1\n"
      "VARIABLE/1, FUNCTION=DIF(7)\nEND\n",
      {3, 6});
  ASSERT_FALSE(c.ok());
  EXPECT_THAT(c.failure, HasSubstr("DIFF/7"));
  EXPECT_THAT(c.failure, ::testing::ContainsRegex("at time (0\\.9999|1)"));
  ASSERT_EQ(c.times.size(), 2u);  // what was before is there
  EXPECT_NEAR(c.last(1), 2, 1e-4);
}

// Steps that error allows are about 0.01 here: they grow up to there, and never become longer.
TEST(Failures, steps_that_stay_shorter_than_is_allowed_end_the_run) {
  const std::string spring =
      "t\nINTEGRATOR/HMIN={}\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, VZ=2\nMARKER/20\nJOINT/1, "
      "TRANSLATIONAL, I=20, J=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-100*DZ(20,1)\n"
      "VARIABLE/1, FUNCTION=DZ(20,1)\nEND\n";
  const Course longer = led_through_time(fmt::format(fmt::runtime(spring), 0.5), {3, 6});
  ASSERT_FALSE(longer.ok());
  EXPECT_THAT(longer.failure, HasSubstr("steps shorter than HMIN"));
  EXPECT_TRUE(led_through_time(fmt::format(fmt::runtime(spring), 1e-6), {3, 6}).ok());
}

TEST(Failures, a_time_to_go_that_no_step_is_short_enough_for_is_told) {
  const Course c = led_through_time(slider + "END\n", {1e-300, 2});
  ASSERT_FALSE(c.ok());
  EXPECT_THAT(c.failure, HasSubstr("the next time is too near for a step"));
}

TEST(Failures, a_force_without_value_is_named_with_its_function) {
  const Course c =
      led_through_time(slider + "SFORCE/7, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=SQRT(1-TIME)\nEND\n", {3, 6});
  ASSERT_FALSE(c.ok());
  EXPECT_THAT(c.failure, HasSubstr("SFORCE/7: SQRT of"));
  EXPECT_THAT(c.failure, HasSubstr("at time 1"));
  EXPECT_EQ(c.times.size(), 3u);
}

TEST(Failures, a_variable_without_value_is_named_though_nothing_reads_it) {
  const Course c = led_through_time(slider + "ACCGRAV/KGRAV=-10\nVARIABLE/4, FUNCTION=LOG(DZ(2))\nEND\n", {3, 6});
  ASSERT_FALSE(c.ok());
  EXPECT_THAT(c.failure, HasSubstr("VARIABLE/4: LOG of"));
  EXPECT_THAT(c.failure, HasSubstr("at time 0.4472"));  // sqrt(0.2)
}

// Base 2.5, crank 2, rod 1 and rocker 1: the crank turns to acos((4 + 6.25 − 4) / 10) = 0.8956647938 at most.
TEST(Failures, a_driven_four_bar_ends_at_its_dead_point) {
  const Course c = led_through_time(R"(t
PART/1, GROUND
MARKER/1, PART=1
MARKER/9, PART=1, QP=2.5,0,0
PART/2, MASS=1, CM=2, IP=1,1,1
MARKER/2, PART=2
MARKER/21, PART=2, QP=2,0,0
PART/3, MASS=1, QG=2,0,0, CM=33, IP=1,1,1, REULER=75.52248781407008D,0,0
MARKER/31, PART=3
MARKER/32, PART=3, QP=1,0,0
MARKER/33, PART=3, QP=0.5,0,0
PART/4, MASS=1, QG=2.5,0,0, CM=41, IP=1,1,1, REULER=104.47751218592992D,0,0
MARKER/41, PART=4
MARKER/42, PART=4, QP=1,0,0
JOINT/1, REVOLUTE, I=2, J=1
JOINT/2, REVOLUTE, I=31, J=21
JOINT/3, REVOLUTE, I=32, J=42
JOINT/4, REVOLUTE, I=41, J=9
MOTION/5, JOINT=1, FUNCTION=TIME
END
)",
                                    {3, 6});
  ASSERT_FALSE(c.ok());
  EXPECT_THAT(c.failure, HasSubstr("at time 0.89566"));
  EXPECT_THAT(c.failure, HasSubstr("a little later"));
  EXPECT_EQ(c.times.size(), 2u);
}

// A part on a hinge, and what drives it.
std::string hinge(const std::string& motions) {
  return "t\nPART/1, GROUND\nMARKER/1, PART=1\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2, PART=2\n"
         "JOINT/1, REVOLUTE, I=2, J=1\n" +
         motions + "END\n";
}

TEST(Failures, motions_that_contradict_each_other_later_are_named) {
  const Course c = led_through_time(hinge(R"(MOTION/1, JOINT=1, FUNCTION=TIME
MOTION/2, I=2, J=1, B3, FUNCTION=TIME+STEP(TIME,1,0,2,0.1)
)"),
                                    {3, 6});
  ASSERT_FALSE(c.ok());
  EXPECT_THAT(c.failure, HasSubstr("contradict"));
  EXPECT_THAT(c.failure, HasSubstr("MOTION/2"));
  EXPECT_EQ(c.times.size(), 3u);
}

TEST(Failures, a_motion_that_jumps_ends_the_run_where_it_jumps) {
  const Course c = led_through_time(hinge(R"(MOTION/1, JOINT=1, FUNCTION=IF(TIME-1: 0, 0.5, 0.5)
)"),
                                    {3, 4});
  ASSERT_FALSE(c.ok());
  EXPECT_THAT(c.failure, HasSubstr("at time 1"));
}

}  // namespace
}  // namespace dynalin::in_time::failures_test

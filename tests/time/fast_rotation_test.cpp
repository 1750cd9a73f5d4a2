// Many turns at little error: rounding of an angle that is counted, or of a course in time, is no error of a step.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "time/course.h"

namespace dynalin::in_time::fast_rotation_test {
namespace {

const std::string wheel =
    "t\nPART/1, GROUND\nMARKER/1, PART=1\nPART/2, MASS=1, CM=20, IP=1,1,2, WZ={}\nMARKER/20, PART=2\n"
    "JOINT/1, REVOLUTE, I=20, J=1\nVARIABLE/1, FUNCTION=AZ(20,1)\nVARIABLE/2, FUNCTION=WZ(20)\n";
std::string wheel_at(double speed) { return fmt::format(fmt::runtime(wheel), speed); }

TEST(FastRotation, a_drive_of_many_turns_is_followed_at_any_error) {
  for (const double error : {1e-6, 1e-8, 1e-9}) {
    for (const char* motion : {"VELOCITY, FUNCTION=100", "FUNCTION=100*TIME"}) {
      const Course c = led_through_time(wheel_at(100) + "MOTION/1, JOINT=1, " + motion + "\nEND\n", {1, 10, error});
      ASSERT_TRUE(c.ok()) << motion << error << c.failure;
      EXPECT_NEAR(c.last(1), 100, 100 * error) << motion;
      EXPECT_NEAR(c.last(2), 100, 100 * error) << motion;
    }
  }
}

TEST(FastRotation, a_coupler_of_flywheels_turns_at_any_error) {
  for (const double error : {1e-6, 1e-8, 1e-9}) {
    const Course c = led_through_time(wheel_at(300) +
                                          "PART/3, MASS=1, CM=30, IP=1,1,1, WZ=100\nMARKER/30, PART=3\n"
                                          "JOINT/3, REVOLUTE, I=30, J=1\nCOUPLER/1, JOINTS=1,3, SCALES=1,-3\n"
                                          "VARIABLE/3, FUNCTION=AZ(30,1)\nEND\n",
                                      {1, 10, error});
    ASSERT_TRUE(c.ok()) << error << c.failure;
    EXPECT_NEAR(c.last(1), 300, 300 * error);
    EXPECT_NEAR(c.last(3), 100, 100 * error);
  }
}

TEST(FastRotation, a_drive_to_and_fro_over_many_turns_ends) {
  const Course c =
      led_through_time(wheel_at(2000) + "MOTION/1, JOINT=1, FUNCTION=100*SIN(20*TIME)\nEND\n", {0.5, 5, 1e-8});
  ASSERT_TRUE(c.ok()) << c.failure;
  EXPECT_NEAR(c.last(1), 100 * std::sin(10.0), 1e-6);
}

// Instants are rounded as well: a drive is as far off as it moves in that.
TEST(FastRotation, drives_late_in_time_are_followed) {
  for (const std::string driven :
       {"REVOLUTE, I=20, J=1\nMOTION/1, JOINT=1, FUNCTION=SIN(100*(TIME-1E4))\nVARIABLE/1, FUNCTION=AZ(20,1)\n",
        "TRANSLATIONAL, I=20, J=1\nMOTION/1, JOINT=1, FUNCTION=SIN(100*(TIME-1E4))\nVARIABLE/1, FUNCTION=DZ(20,1)\n",
        "TRANSLATIONAL, I=20, J=1\nGCON/1, FUNCTION=DZ(20,1)-SIN(100*(TIME-1E4))\nVARIABLE/1, FUNCTION=DZ(20,1)\n"}) {
    StudyPoint late = drawn_point(
        "t\nPART/1, GROUND\nMARKER/1, PART=1\nPART/2, MASS=1, CM=20, IP=1,1,2\nMARKER/20, PART=2\nJOINT/1, " + driven +
        "END\n");
    late.values.time = 1e4;
    const Course c = led_through_time(std::move(late), {1e4 + 1, 10, 1e-8});
    ASSERT_TRUE(c.ok()) << driven << c.failure;
    EXPECT_NEAR(c.last(1), std::sin(100.0), 1e-8) << driven;
  }
}

// ω × J ω of a ball is rounding and nothing else; a body that is almost one has little more.
TEST(FastRotation, a_ball_spins_about_one_axis_as_long_as_it_will) {
  for (const double polar : {0.1, 0.1 * (1 + 1e-9)}) {
    for (const char* held : {"", "JOINT/1, SPHERICAL, I=20, J=1\n"}) {
      for (const char* spin : {"WZ=3", "WX=0.7, WY=-0.2", "WX=300, WY=400, WZ=50"}) {
        const Course c = led_through_time(
            fmt::format("t\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=0.1,0.1,{:.17g}, {}\nMARKER/20\n{}"
                        "VARIABLE/1, FUNCTION=WM(20)\nEND\n",
                        polar, spin, held),
            {2, 300, 1e-6});
        ASSERT_TRUE(c.ok()) << polar << held << spin << c.failure;
        EXPECT_LT(c.drift(1), 1e-7 * c.largest(1)) << spin;
      }
    }
  }
}

// So does a flexible body whose modes do not move what turns it.
TEST(FastRotation, a_beam_of_finite_elements_spins_about_its_axis) {
  const Course c = led_through_time(
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMATERIAL/1, DENSITY=7800, YOUNGS_MODULUS=2E11, "
      "POISSONS_RATIO=0.3\nFE_PART/2, TYPE=3DBEAM, MATERIAL=1, NODE_LABELS=1,2,3, X=0,0.5,1, AREA=1E-2, IYY=8E-6, "
      "IZZ=8E-6, WX=30\nMARKER/20, FE_PART=2, NODE_LABEL=2, QP=0.5,0,0\nVARIABLE/1, FUNCTION=WM(20)\nEND\n",
      {1, 100, 1e-6});
  ASSERT_TRUE(c.ok()) << c.failure;
  EXPECT_NEAR(c.last(1), 30, 1e-5);
}

}  // namespace
}  // namespace dynalin::in_time::fast_rotation_test

// Joints that the dataset turns by more than half a turn at the start: the IC of a joint or a MOTION says how far, and
// what COUPLER and GEAR lead with it goes as far.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>

#include "cases/run.h"
#include "cases/study_of.h"

namespace dynalin::cases::stated_turns_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Three wheels about parallel axes; VARIABLE/k is the angle of wheel k.
std::string wheels(const std::string& ic, const std::string& more) {
  return "Wheels\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/9, QP=3,0,0\nMARKER/8, QP=6,0,0\nMARKER/5, "
         "QP=1,0,0, REULER=0,90D,0\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2\nPART/3, MASS=1, CM=3, IP=1,1,1, "
         "QG=3,0,0\nMARKER/3\nPART/4, MASS=1, CM=4, IP=1,1,1, QG=6,0,0\nMARKER/4\nJOINT/1, REVOLUTE, I=2, J=1" +
         ic +
         "\nJOINT/2, REVOLUTE, I=3, J=9\nJOINT/3, REVOLUTE, I=4, J=8\nVARIABLE/1, FUNCTION=AZ(2,1)\nVARIABLE/2, "
         "FUNCTION=AZ(3,9)\nVARIABLE/3, FUNCTION=AZ(4,8)\n" +
         more + "END\n";
}

class StatedTurns : public Cases {
 protected:
  void expect_angles(const std::string& dataset, double first, double second, double third) const {
    const auto study = study_of(dataset);
    const auto m = study.initial_conditions();
    EXPECT_NEAR(m.variable(1), first * degree, 1e-12) << dataset;
    EXPECT_NEAR(m.variable(2), second * degree, 1e-12) << dataset;
    EXPECT_NEAR(m.variable(3), third * degree, 1e-12) << dataset;
  }
};

TEST_F(StatedTurns, are_counted_as_a_joint_begins_with_them) {
  for (const double turn : {100.0, 200.0, -200.0, 359.0, 1000.0}) {
    const std::string ic = fmt::format(", IC={:g}D", turn);
    expect_angles(wheels(ic, "COUPLER/1, JOINTS=1,2, SCALES=-2\n"), turn, turn / 2, 0);
    // Three meet in the second coupler, of which two follow.
    expect_angles(wheels(ic, "COUPLER/2, JOINTS=1,2,3, SCALES=1,1,-1\nCOUPLER/1, JOINTS=1,2, SCALES=-2\n"), turn,
                  turn / 2, 1.5 * turn);
    expect_angles(wheels(ic, "GEAR/1, JOINTS=1,2, CV=5\nCOUPLER/1, JOINTS=2,3, SCALES=3\n"), turn, -turn / 2, turn / 6);
  }
}

TEST_F(StatedTurns, are_counted_as_a_motion_drives_them) {
  const std::string couplers = "COUPLER/1, JOINTS=1,2, SCALES=-2\nCOUPLER/2, JOINTS=2,3, SCALES=-0.25\n";
  for (const char* motion :
       {"MOTION/1, JOINT=1, FUNCTION=700D+TIME", "MOTION/1, JOINT=1, VELOCITY, ICDISP=700D, FUNCTION=3",
        "MOTION/1, JOINT=1, ACCELERATION, ICDISP=700D, ICVEL=1, FUNCTION=3"})
    expect_angles(wheels("", couplers + motion + "\n"), 700, 350, 1400);
  // It holds where an IC says otherwise.
  expect_angles(wheels(", IC=340D", couplers + "MOTION/1, JOINT=1, FUNCTION=700D\n"), 700, 350, 1400);
  // Where it says nothing of the displacement, the drawing does.
  expect_angles(wheels("", couplers + "MOTION/1, JOINT=1, VELOCITY, FUNCTION=3\n"), 0, 0, 0);
}

// What no statement says goes on from the drawing.
TEST_F(StatedTurns, are_those_of_the_drawing_where_nothing_is_stated) {
  expect_angles(wheels("", "COUPLER/1, JOINTS=1,2, SCALES=-2\n"), 0, 0, 0);
  expect_angles(wheels(", IC=200D", ""), 200, 0, 0);
}

// A torsion spring that is wound up by 200 degrees, on a wheel of inertia 1: θ″ = −k θ.
TEST_F(StatedTurns, wind_up_springs) {
  const auto study =
      study_of(wheels(", IC=200D", "SPRINGDAMPER/1, ROTATION, I=2, J=1, KT=3\nVARIABLE/4, FUNCTION=WDTZ(2)\n"));
  EXPECT_NEAR(study.initial_conditions().variable(4), -3 * 200 * degree, 1e-11);
}

}  // namespace
}  // namespace dynalin::cases::stated_turns_test

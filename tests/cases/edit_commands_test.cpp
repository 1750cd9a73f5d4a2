// Commands that change the model between analyses: redefinition, ACTIVATE and DEACTIVATE.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/run.h"
#include "command/planner.h"

namespace dynalin::cases::edit_commands_test {
namespace {

using ::testing::HasSubstr;
constexpr double turn = 2 * std::numbers::pi;

// A mass of 2 on a spring of 8: ω = 2.
const std::string oscillator =
    "oscillator\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1\nMARKER/20\n"
    "MARKER/21, PART=2, QP=0,0,1\nMARKER/3, PART=1, QP=0,0,-2\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
    "SPRINGDAMPER/1, TRANSLATIONAL, I=21, J=3, K=8, LENGTH=3\n";

class EditCommands : public Cases {
 protected:
  void expect_frequency(const RunResult& r, std::size_t k, double omega, double relative = 1e-12) const {
    expect_eigenvalues(r.eigenvalues(k), {{0, omega / turn}}, relative);
  }
};

TEST_F(EditCommands, an_argument_that_is_defined_anew_counts_from_then_on) {
  const RunResult r = run(oscillator + "END\n",
                          "LINEAR/EIGENSOL\nSPRINGDAMPER/1, K=50\nLINEAR/EIGENSOL\npart/2, m=8\nspr/1, &\n  ! note\n , "
                          "k=2, &\n l=3\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 0, 2);
  expect_frequency(r, 2, 5);
  expect_frequency(r, 5, 0.5);
}

TEST_F(EditCommands, expressions_are_defined_anew_and_read_what_others_define) {
  const RunResult r = run(oscillator +
                              "VARIABLE/1, FUNCTION=0\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, "
                              "FUNCTION=-VARVAL(1)*DZ(20,1)\nEND\n",
                          "LINEAR/EIGENSOL\nVARIABLE/1, FUNC=10\nLINEAR/EIGENSOL\nSFORCE/1, FUNCTION=-(VARVAL(1)\n, "
                          "+32)*DZ(20,1)\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 0, 2);
  expect_frequency(r, 2, 3);
  expect_frequency(r, 4, 5);
}

// With all that goes with the one that it was.
TEST_F(EditCommands, a_contact_changes_its_law) {
  const RunResult r = run(
      "ball\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0,0.4\nMARKER/20\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1\nGRAPHICS/1, PLANE, RM=1, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1\nGRAPHICS/2, "
      "ELLIPSOID, CM=20, XSCALE=1, YSCALE=1, ZSCALE=1\nCONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=50, EXPONENT=1, "
      "DAMPING=0, DMAX=0.01\nEND\n",
      "LINEAR/EIGENSOL\nCONTACT/1, POISSON, PENALTY=200, RESTITUTION_COEFFICIENT=1\nLINEAR/EIGENSOL\nCONTACT/1, "
      "IMPACT, "
      "STIFFNESS=18, EXPONENT=1, DAMPING=0, DMAX=0.01\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 0, 5);
  expect_frequency(r, 2, 10);
  expect_frequency(r, 4, 3);
}

// Twice as deep, twice as stiff.
TEST_F(EditCommands, the_shape_of_a_contact_changes_its_size) {
  const std::string ball =
      "ball\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0,0.4\nMARKER/20\n"
      "JOINT/1, TRANSLATIONAL, I=20, J=1\nGRAPHICS/1, PLANE, RM=1, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1\nGRAPHICS/2, "
      "ELLIPSOID, CM=20, XSCALE=1, YSCALE=1, ZSCALE=1\nCONTACT/1, IGEOM=2, JGEOM=1, IMPACT, STIFFNESS=250, EXPONENT=2, "
      "DAMPING=0, DMAX=0.01\nEND\n";
  const RunResult r = run(ball, "LINEAR/EIGENSOL\ngraph/2, xscale=1.2, ysc=1.2, zscale=1.2\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 0, 5);
  expect_frequency(r, 2, std::sqrt(50.0));
  EXPECT_THAT(run(ball, "GRAPHICS/2, BOX\n").err, HasSubstr("GRAPHICS/2 is both ELLIPSOID and BOX"));
  EXPECT_THAT(run(ball, "GRAPHICS/2, RADIUS=1\n").err,
              HasSubstr("nothing here acts on GRAPHICS/RADIUS, which is passed over"));
  EXPECT_THAT(run(ball, "GRAPHICS/3, XSCALE=2\n").err, HasSubstr("GRAPHICS/3 does not exist"));
}

TEST_F(EditCommands, deactivated_elements_exert_nothing_and_come_back) {
  const RunResult r = run(oscillator +
                              "BUSHING/7, I=20, J=1, K=0,0,10\nSFORCE/9, TRANSLATIONAL, ACTIONONLY, I=20, J=1, "
                              "FUNCTION=-DZ(20,1)*(32+SPDP(1,0,4,0))+3*BUSH(7,0,4,0)\nEND\n",
                          "LINEAR/EIGENSOL\nDEACTIVATE/BUSHING, ID=7\nLINEAR/EIGENSOL\nDEACT/SFORCE, "
                          "RANGE=5,12\nLINEAR/EIGENSOL\nACTIVATE/BUSHING, ID=7\nACTIVATE/SFORCE, RANGE=9,9\nLINEAR/"
                          "EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 0, std::sqrt((8 + 10 + 30 + 32) / 2.0));
  expect_frequency(r, 2, std::sqrt((8 + 32) / 2.0));
  expect_frequency(r, 4, 2);
  expect_frequency(r, 7, std::sqrt((8 + 10 + 30 + 32) / 2.0));
}

TEST_F(EditCommands, a_lock_that_is_taken_out_leaves_the_pose_where_it_is) {
  // A pendulum held at 60 degrees by a motion; let go, it is not in equilibrium, and its stiffness is that of the pose.
  const RunResult r = run(
      "t\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\nPART/2, QG=0,-1,0, MASS=1, CM=20, "
      "IP=0,0,3\nMARKER/20\nMARKER/21, QP=0,1,0\nJOINT/1, REVOLUTE, I=21, J=1\nMOTION/1, JOINT=1, FUNCTION=60D\nEND\n",
      "SIMULATE/STATIC\nDEACTIVATE/MOTION, ID=1\nLINEAR/EIGENSOL\nACTIVATE/MOTION, ID=1\nMOTION/1, "
      "FUNCTION=0\nSIMULATE/INITIAL\nDEACTIVATE/MOTION, ID=1\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 2, std::sqrt(10 * 0.5 / 4));
  expect_frequency(r, 7, std::sqrt(10.0 / 4));
}

TEST_F(EditCommands, velocities_go_on_when_a_motion_is_taken_out) {
  const auto arm = [](const std::string& rate, const std::string& motion) {
    return "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=2, IP=1,1,5" + rate +
           "\nMARKER/2\nMARKER/4, REULER=90D,90D,0\nPART/3, QG=1,0,0, MASS=2, CM=3, IP=1,1,1\nMARKER/3, "
           "REULER=90D,90D,0\nJOINT/1, REVOLUTE, I=2, J=1\n" +
           motion + "JOINT/2, TRANSLATIONAL, I=3, J=4\nBUSHING/1, I=3, J=4, K=0,0,200\nEND\n";
  };
  const RunResult edited = run(arm("", "MOTION/1, JOINT=1, FUNCTION=6*TIME\n"),
                               "LINEAR/EIGENSOL, RM=2\nDEACTIVATE/MOTION, ID=1\nLINEAR/STATEMAT, FILE=a, RM=2\n");
  const RunResult stated = run(arm(", WZ=6", ""), "LINEAR/STATEMAT, FILE=a, RM=2\n");
  ASSERT_EQ(edited.status, 0) << edited.err;
  ASSERT_EQ(stated.status, 0) << stated.err;
  expect_frequency(edited, 0, 8);
  const auto A = edited.matrix(2, "A"), wanted = stated.matrix(0, "A");
  ASSERT_EQ(A.size(), wanted.size());
  ASSERT_EQ(A.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(A[i][j], wanted[i][j], 1e-11) << i << j;
  }
}

TEST_F(EditCommands, turns_of_an_angle_are_remembered) {
  // Balanced at 5 radians, which an angle that forgot its turn would take for 5 − 2π; 0.3·25 + 1 = 8.5.
  const RunResult r = run(
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, REVOLUTE, "
      "I=20, J=1\nSFORCE/1, ROTATIONAL, I=20, J=1, FUNCTION=17.5-AZ(20,1)-0.1*AZ(20,1)**3\nSPRINGDAMPER/1, ROTATIONAL, "
      "I=20, J=1, KT=0, ANGLE=5\nEND\n",
      "SIMULATE/STATIC\nLINEAR/EIGENSOL\nSPRINGDAMPER/1, KT=3\nLINEAR/EIGENSOL\nSIMULATE/STATIC\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 1, std::sqrt(8.5), 1e-10);
  expect_frequency(r, 3, std::sqrt(11.5), 1e-10);
  expect_frequency(r, 5, std::sqrt(11.5), 1e-10);
}

TEST_F(EditCommands, a_part_begins_where_a_command_puts_it_and_stays_where_only_its_speed_is_stated) {
  const std::string cubic =
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, QG=0,0,1, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, "
      "TRANSLATIONAL, I=20, J=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=8-DZ(20,1)**3\nEND\n";
  const RunResult r = run(cubic, "SIMULATE/STATIC\nPART/2, VZ=3\nLINEAR/EIGENSOL\nPART/2, QG=0,0,3\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 2, std::sqrt(12.0), 1e-10);
  expect_frequency(r, 4, std::sqrt(27.0));
}

TEST_F(EditCommands, differential_states_go_on_by_id) {
  // The force reads a state that rests at 3 only where it was found; an element in front of it comes and goes.
  const RunResult sound = run(oscillator +
                                  "BUSHING/1, I=20, J=1, K=0,0,1\nDIFF/1, IC=9, FUNCTION=-DIF(1)\nDIFF/2, IC=1, "
                                  "FUNCTION=3-DIF(2)\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, "
                                  "FUNCTION=-14*DIF(2)*DZ(20,1)\nEND\n",
                              "SIMULATE/STATIC\nDEACTIVATE/BUSHING, ID=1\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(sound.status, 0) << sound.err;
  expect_eigenvalues(sound.eigenvalues(2), {{-1 / turn, 0}, {-1 / turn, 0}, {0, std::sqrt((8 + 14 * 3) / 2.0) / turn}},
                     1e-12);
}

TEST_F(EditCommands, one_way_of_stating_a_thing_ends_the_other) {
  const RunResult r =
      run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, ZP=0,0,1, XP=1,0,0\nPART/2, MASS=1, CM=20, "
          "IP=1,1,1\nMARKER/20, ZP=0,0,1, XP=1,0,0\nJOINT/1, TRANSLATIONAL, I=20, J=1\nBUSHING/1, I=20, J=1, "
          "K=0,0,25\nMOTION/1, JOINT=1, VELOCITY, FUNCTION=3, ICDISP=0\nEND\n",
          "MOTION/1, DISPLACEMENT, FUNCTION=0\nSIMULATE/STATIC\nDEACTIVATE/MOTION, ID=1\nMARKER/1, "
          "REULER=90D,90D,0\nMARKER/20, R=90D,90D,0\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 5, 5);
  EXPECT_THAT(r.labels(5), ::testing::Contains(HasSubstr("DX(BCS)")));
}

TEST_F(EditCommands, a_joint_may_become_another_type) {
  const RunResult r =
      run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,4\nMARKER/20\n"
          "JOINT/1, TRANSLATIONAL, I=20, J=1\nBUSHING/1, I=20, J=1, K=0,0,25, KT=0,0,36\nEND\n",
          "LINEAR/EIGENSOL\nJOINT/1, REVOLUTE\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 0, 5);
  expect_frequency(r, 2, 3);
}

TEST_F(EditCommands, what_only_the_type_before_has_goes_with_it) {
  const RunResult r = run(
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=3,3,4\nMARKER/20\n"
      "MARKER/2, PART=1, QP=0,0,-1\nJOINT/1, CYLINDRICAL, I=20, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=2, K=25, "
      "LENGTH=1\nBUSHING/1, I=20, J=1, K=0,0,25, KT=0,0,36\nEND\n",
      "SPRINGDAMPER/1, ROTATIONAL, KT=64\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto values = r.eigenvalues(1);
  ASSERT_EQ(values.size(), 4u);
  EXPECT_NEAR(values[0].imag() * turn, 5, 1e-11);
  EXPECT_NEAR(values[2].imag() * turn, 5, 1e-11);
}

TEST_F(EditCommands, before_the_first_analysis_edits_count_as_if_written_in_the_dataset) {
  const RunResult r =
      run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nJOINT/1, "
          "TRANSLATIONAL, I=20, J=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=-DZ(20,1)**3\nEND\n",
          "PART/2, QG=0,0,2\nLINEAR/EIGENSOL\nPART/2, QG=0,0,3\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 1, std::sqrt(12.0));
  expect_frequency(r, 3, std::sqrt(27.0));
}

// The markers of the part are 1 apart and a million from its origin as written, so one of them is taken as origin: the
// CM, which an edit may give to the other.
TEST_F(EditCommands, a_part_whose_origin_is_far_away_stays_when_it_gets_another_one) {
  const RunResult slider =
      run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, QG=0,0,1e6, MASS=1, CM=20, IP=1,1,1\nMARKER/20, "
          "QP=0,0,-1e6\nMARKER/22, QP=0,0,-999999\nJOINT/1, TRANSLATIONAL, I=20, J=1\nSFORCE/1, TRANSLATIONAL, "
          "ACTIONONLY, I=20, J=1, FUNCTION=8-DZ(20,1)**3\nEND\n",
          "SIMULATE/STATIC\nPART/2, CM=22, MASS=3\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(slider.status, 0) << slider.err;
  EXPECT_THAT(slider.err, HasSubstr("MARKER/22 is taken instead"));
  expect_frequency(slider, 2, 2, 1e-8);  // a million is known to 1e-10

  const auto plate = [](const std::string& more) {
    return "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/4, REULER=0,90D,0\nPART/2, QG=1e6,0,0, MASS=1, "
           "IP=1,1,1, WZ=3, " +
           more +
           "\nMARKER/20, QP=-1e6,0,0\nMARKER/22, QP=-999999,0,0\nJOINT/1, PLANAR, I=20, J=1\nSFORCE/1, "
           "TRANSLATIONAL, ACTIONONLY, I=20, J=4, FUNCTION=VY(22,1)**3\nEND\n";
  };
  const RunResult edited = run(plate("CM=20"), "SIMULATE/INITIAL_CONDITIONS\nPART/2, CM=22\nLINEAR/STATEMAT, FILE=a\n");
  const RunResult stated = run(plate("CM=22, VY=3"), "LINEAR/STATEMAT, FILE=a\n");
  ASSERT_EQ(edited.status, 0) << edited.err;
  ASSERT_EQ(stated.status, 0) << stated.err;
  const auto A = edited.matrix(2, "A"), wanted = stated.matrix(0, "A");
  ASSERT_EQ(A.size(), 6u);
  ASSERT_EQ(wanted.size(), 6u);
  double largest = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_NEAR(A[i][j], wanted[i][j], 1e-7) << i << j;
      largest = std::max(largest, std::abs(wanted[i][j]));
    }
  }
  EXPECT_GT(largest, 20);  // 3 · 3² at the marker that was not the origin
}

TEST_F(EditCommands, settings_of_initial_conditions_hold_for_models_to_come_and_end) {
  // The second joint asks for a place 1e-7 beside that of the first.
  const std::string doors =
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=1E-7,0,1\nPART/2, MASS=1, CM=20, IP=1,1,1\n"
      "MARKER/20, QP=1,0,0\nMARKER/21\nMARKER/22, QP=0,0,1\nJOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=22, "
      "J=2\nSPRINGDAMPER/1, ROTATIONAL, I=21, J=1, KT=8\nEND\n";
  const std::string edit = "DEACTIVATE/JOINT, ID=2\nLINEAR/EIGENSOL\nIC/ERROR=1E-6\nACTIVATE/JOINT, ID=2\n";
  EXPECT_EQ(run(doors, "LINEAR/EIGENSOL\n").status, 2);
  const RunResult wide = run(doors, edit + "LINEAR/EIGENSOL\n");
  ASSERT_EQ(wide.status, 0) << wide.err;
  expect_frequency(wide, 4, 2, 1e-5);
  EXPECT_EQ(run(doors, edit + "IC/DEFAULT\nLINEAR/EIGENSOL\n").status, 2);
}

TEST_F(EditCommands, gravity_may_be_switched_and_stated_for_the_first_time) {
  const std::string pendulum =
      "PART/1, GROUND\nMARKER/1\nPART/2, QG=0,-1,0, MASS=1, CM=20, IP=0,0,3\nMARKER/20\nMARKER/21, QP=0,1,0\nJOINT/1, "
      "REVOLUTE, I=21, J=1\nEND\n";
  const RunResult r = run("t\nUNITS/SYSTEM=MKS\n" + pendulum,
                          "ACCGRAV/JGRAV=-16\nLINEAR/EIGENSOL\nACCGRAV/J=-36\nLINEAR/"
                          "EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 1, 2);
  expect_frequency(r, 3, 3);
}

// What a dataset has once is found by its keyword, whatever id somebody wrote behind it.
TEST_F(EditCommands, an_id_of_what_exists_once_means_nothing) {
  const std::string pendulum =
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, QG=0,-1,0, MASS=1, CM=20, IP=0,0,3\nMARKER/20\n"
      "MARKER/21, QP=0,1,0\nJOINT/1, REVOLUTE, I=21, J=1\n";
  for (const auto& [stated, command] :
       {std::pair{"ACCGRAV/JGRAV=-16\n", "ACCGRAV/1, "}, std::pair{"ACCGRAV/1, JGRAV=-16\n", "ACCGRAV/"},
        std::pair{"ACCGRAV/1, JGRAV=-16\n", "ACCGRAV/2, "}}) {
    const RunResult r = run(pendulum + stated + "END\n", "LINEAR/EIGENSOL\n" + std::string(command) +
                                                             "JGRAV=-36\nLINEAR/EIGENSOL\n" + command + "LIST\n");
    ASSERT_EQ(r.status, 0) << r.err;
    expect_frequency(r, 0, 2);
    expect_frequency(r, 2, 3);
    EXPECT_THAT(r.message, HasSubstr("JGRAV = -36")) << stated << command;
  }
}

TEST_F(EditCommands, list_says_what_holds_without_being_stated) {
  const std::string model =
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
      "MARKER/21, PART=1, QP=1,0,0\nJOINT/1, REVOLUTE, I=20, J=1\n";
  const auto listed = [&](const std::string& more, const std::string& command) {
    const RunResult r = run(model + more + "END\n", command + "\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.out;
  };
  EXPECT_THAT(listed("", "ACCGRAV/LIST"),
              HasSubstr("\nCurrent ACCGRAV data are:\n   IGRAV = 0\n   JGRAV = 0\n   KGRAV = 0\n"));
  EXPECT_THAT(listed("ACCGRAV/JG=-9.8\n", "ACCGRAV/LIST"),
              HasSubstr("data are:\n   JG    = -9.8\n   IGRAV = 0\n   KGRAV = 0\n"));
  EXPECT_THAT(listed("", "ACCGRAV/KGRAV=3, LIST"), HasSubstr("   KGRAV = 3\n   IGRAV = 0\n   JGRAV = 0\n"));
  EXPECT_THAT(listed("", "MARKER/20, LIST"), HasSubstr("Current MARKER/20 data are:\n   it belongs to PART/2\n"));
  EXPECT_THAT(listed("", "MARKER/21, LIST"), HasSubstr("data are:\n   PART = 1\n   QP   = 1,0,0\n\n"));
}

TEST_F(EditCommands, what_goes_with_the_type_before_is_named) {
  const RunResult r = run(oscillator + "END\n", "SPRINGDAMPER/1, ROTATIONAL\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("model.acf:3:1: warning: K, LENGTH of SPRINGDAMPER/1 are dropped with its type: "
                               "ROTATIONAL has no such argument [dropped-argument]"));
  EXPECT_EQ(r.err.find("dropped-argument"), r.err.rfind("dropped-argument")) << r.err;
}

// Of a table of arguments that all types have in common, too.
TEST_F(EditCommands, what_goes_with_the_type_of_a_joint_goes_with_it) {
  const auto said_of = [&](const std::string& joint, const std::string& edit) {
    const RunResult r =
        run("t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2\n"
            "BUSHING/1, I=2, J=1, K=1,1,1, KT=1,1,1\nJOINT/1, " +
                joint + ", I=2, J=1\nEND\n",
            edit + "\nLINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err;
  };
  EXPECT_THAT(said_of("REVOLUTE, IC=.2,.4", "JOINT/1, CYLINDRICAL"),
              HasSubstr("IC of JOINT/1 is dropped with its type: CYLINDRICAL has no such argument"));
  EXPECT_THAT(said_of("CYLINDRICAL, ICTRAN=.1, ICROT=.2,.4", "JOINT/1, TRANSLATIONAL, IC=.3"),
              HasSubstr("ICTRAN, ICROT of JOINT/1 are dropped"));
  EXPECT_THAT(said_of("SCREW, PITCH=.1", "JOINT/1, REVOLUTE"), HasSubstr("PITCH of JOINT/1 is dropped"));
  EXPECT_THAT(said_of("SCREW, PITCH=.1", "JOINT/1, CYLINDRICAL, ICROT=.2"), HasSubstr("PITCH of JOINT/1 is dropped"));
  EXPECT_EQ(said_of("REVOLUTE, IC=.2,.4", "JOINT/1, TRANSLATIONAL").find("dropped"), std::string::npos);
}

// They leave the model and its point as they are, to the last bit.
TEST_F(EditCommands, edits_that_change_nothing_are_as_if_nothing_had_been_said) {
  const std::string swinging =
      "two\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=.3,.4,.5, "
      "QG=.7,.1,.2, REULER=.3,.2,.1\nMARKER/20\nMARKER/21, QP=-.7,-.1,-.2\nMARKER/22, QP=.4,.1,0\nPART/3, MASS=2, "
      "CM=30, IP=.3,.4,.5, QG=1.4,.1,.4, REULER=1.3,.4,.1\nMARKER/30\nMARKER/31, QP=-.4,.1,0\nJOINT/1, SPHERICAL, "
      "I=21, J=1\nJOINT/2, SPHERICAL, I=31, J=22\nBUSHING/1, I=30, J=1, K=1,1,1, C=.1,.1,.1\nEND\n";
  const auto end = [&](const std::string& between) {
    const RunResult r = run(swinging, "SIMULATE/DYNAMICS, END=.3\n" + between + "SIMULATE/DYNAMICS, END=.6\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.json.at("results").back().at("operating_point").dump();
  };
  const std::string wanted = end("TIME\n");
  EXPECT_EQ(end("BUSHING/1, C=.1,.1,.1, K=1,1,1\n"), wanted);
  EXPECT_EQ(end("DEACTIVATE/JOINT, ID=2\nACTIVATE/JOINT, ID=2\n"), wanted);
  EXPECT_EQ(end("BUSHING/1, K=2,1,1\nBUSHING/1, K=1,1,1\nTIME\n"), wanted);
  EXPECT_NE(end("BUSHING/1, K=2,1,1\n"), wanted);
}

// More edits one by one than models are kept for.
TEST_F(EditCommands, each_of_many_edits_counts_in_its_turn) {
  std::string commands;
  for (int k = 1; k <= 30; ++k) commands += "SPRINGDAMPER/1, K=" + std::to_string(2 * k * k) + "\nLINEAR/EIGENSOL\n";
  SessionOptions options;
  write("model.adm", oscillator + "END\n");
  write("model.acf", "model\nmodel\n" + commands);
  options.file = (folder_ / "model.acf").string();
  std::ostringstream said;
  const auto plan = planned(options, said);
  ASSERT_TRUE(plan) << said.str();
  const auto& stages = plan->jobs.front().stages;
  EXPECT_EQ(stages.size(), 31u);
  EXPECT_LT(std::ranges::count_if(stages, [](const Job::Stage& s) { return s.is_there(); }), 15);
  EXPECT_TRUE(stages.back().is_there());

  const RunResult r = run_file("model.acf");
  ASSERT_EQ(r.status, 0) << r.err;
  for (std::size_t k = 1; k <= 30; ++k) expect_frequency(r, 2 * k - 1, static_cast<double>(k));
}

TEST_F(EditCommands, a_redundant_lock_comes_and_goes) {
  const RunResult r =
      run(oscillator + "JOINT/2, FIXED, I=20, J=1\nJPRIM/1, INPLANE, I=20, J=3\nMARKER/4, PART=1\nEND\n",
          "DEACTIVATE/JOINT, ID=2\nDEACTIVATE/JPRIM, RANGE=1,9\nSIM/STAT\nLINEAR/EIGENSOL\nACTIVATE/"
          "JOINT, ID=2\nSIMULATE/STATIC\n");
  ASSERT_EQ(r.status, 0) << r.err;
  expect_frequency(r, 3, 2);
}

TEST_F(EditCommands, mistakes_stand_at_their_place_and_nothing_runs) {
  const auto error = [&](const std::string& commands) {
    const RunResult r = run(oscillator + "END\n", "LINEAR/EIGENSOL\n" + commands + "\n");
    EXPECT_EQ(r.status, 1) << commands;
    EXPECT_FALSE(r.wrote("model.msg")) << commands;
    return r.err;
  };
  EXPECT_THAT(error("SPRINGDAMPER/2, K=5"), HasSubstr("model.acf:4:1: error: SPRINGDAMPER/2 does not exist"));
  EXPECT_THAT(error("SPRINGDAMPER/1, KK=5"), HasSubstr("model.acf:4:17: error"));
  EXPECT_THAT(error("SPRINGDAMPER/1, K=-5"), HasSubstr("model.acf:4:19: error"));
  EXPECT_THAT(error("SPRINGDAMPER/1, I=77"), HasSubstr("model.acf:4:19: error"));
  EXPECT_THAT(error("SPRINGDAMPER/1, K=5\nLINEAR/EIGENSOL\nMARKER/21, QP=1,2"), HasSubstr("model.acf:6:15: error"));
  EXPECT_THAT(error("MARKER/77, QP=1,2,3"), HasSubstr("[unknown-element]"));
  EXPECT_THAT(error("PART/3, MASS=3"), HasSubstr("[unknown-element]"));
  EXPECT_THAT(error("SPRINGDAMPER, K=5"), HasSubstr("[missing-id]"));
  EXPECT_THAT(error("DEACTIVATE/JOINT, ID=1,7"), HasSubstr("model.acf:4:24: error: JOINT/7 does not exist"));
  EXPECT_THAT(error("DEACTIVATE/MARKER, ID=1"), HasSubstr("model.acf:4:12: error"));
  EXPECT_THAT(error("DEACTIVATE/JOINT, RANGE=7,9"), HasSubstr("[unknown-element]"));
  EXPECT_THAT(error("DEACTIVATE/JOINT, RANGE=7"), HasSubstr("[wrong-count]"));
  EXPECT_THAT(error("DEACTIVATE/JOINT"), HasSubstr("[missing-argument]"));
  EXPECT_THAT(error("DEACTIVATE/JOINT, ID=1, RANGE=1,2"), HasSubstr("[excluded-arguments]"));
  EXPECT_THAT(error("ACTIVATE/JOINT, MOTION, ID=1"), HasSubstr("[excluded-arguments]"));
  EXPECT_THAT(error("ACTIVATE/JOINT, IDS=1"), HasSubstr("[unknown-argument]"));
  for (const char* switching : {"DEACTIVATE", "ACTIVATE"}) {
    const std::string command = switching;
    EXPECT_THAT(error(command + "/JOINT, ID=1, ID=2"), HasSubstr("ID of " + command + " is given twice [duplicate-"));
    EXPECT_THAT(error(command + "/JOINT, RANGE=1,2, RANGE=3,4"), HasSubstr("[duplicate-argument]"));
  }
  EXPECT_THAT(error("DEACTIVATE/BUSHNG, ID=1"), HasSubstr("hint: did you mean BUSHING?"));
  EXPECT_THAT(error("DEACTIVATE/G, ID=1"), HasSubstr("hint: it could be "));
}

// The dataset was sound: a note shows what in it does not go with the command.
TEST_F(EditCommands, what_they_lead_to_is_reported_at_the_command) {
  const auto error = [&](const std::string& commands) {
    const RunResult r =
        run(oscillator + "SFORCE/1, TRANSLATIONAL, I=20, J=1, FUNCTION=1\nEND\n", commands + "\nLINEAR/EIGENSOL\n");
    EXPECT_EQ(r.status, 1) << commands;
    return r.err;
  };
  const std::string alone = error("SFORCE/1, I=1");
  EXPECT_THAT(alone, HasSubstr("model.acf:3:11: error: I and J of SFORCE/1 are both on PART/1"));
  EXPECT_THAT(alone, HasSubstr("note: what does not go with it stands here"));
  EXPECT_THAT(error("MARKER/20, PART=1"), HasSubstr("model.acf:3:12: error:"));
  EXPECT_THAT(error("PART/2, CM=1"), HasSubstr("model.acf:3:9: error:"));
  // Of several the one that has brought it about.
  const std::string second = error("PART/2, MASS=3\nSFORCE/1, I=1, FUNCTION=2\nSPRINGDAMPER/1, K=5");
  EXPECT_THAT(second, HasSubstr("model.acf:4:1: error: I and J of SFORCE/1 are both on PART/1"));
}

// What an edit makes of a statement of the dataset is said there, once; what was said of the dataset is not said again.
TEST_F(EditCommands, warnings_that_they_bring_about_in_the_dataset_are_said_once) {
  const std::string door =
      "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
      "MARKER/21, PART=2, REULER=0,9D,0\nJOINT/1, SPHERICAL, I=20, J=1\n"
      "SFORCE/1, ROTATION, I=20, J=1, FUNCTION=-AZ(20,1)\nSFORCE/2, ROTATION, I=21, J=1, FUNCTION=-AZ(20,1)\nEND\n";
  const RunResult r = run(door,
                          "SIMULATE/INITIAL\nMARKER/20, REULER=0,10D,0\nSIMULATE/INITIAL\nPART/2, MASS=2\n"
                          "LINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 0) << r.err;
  const auto times = [&](const std::string& part) {
    std::size_t n = 0;
    for (auto at = r.err.find(part); at != std::string::npos; at = r.err.find(part, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(times("model.adm:9:1: warning: the z axes of MARKER/20"), 1u) << r.err;
  EXPECT_EQ(times("model.adm:10:1: warning: the z axes of MARKER/21"), 1u) << r.err;
}

TEST_F(EditCommands, an_element_that_is_active_already_gets_a_warning) {
  const RunResult r = run(oscillator + "END\n", "ACTIVATE/JOINT, ID=1\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("model.acf:3:20: warning: JOINT/1 is active already [already-so]"));
}

TEST_F(EditCommands, a_motion_on_a_joint_that_is_taken_out_is_refused) {
  const RunResult r = run(oscillator + "MOTION/1, JOINT=1, FUNCTION=0\nEND\n", "DEACTIVATE/JOINT, ID=1\nSIM/STATIC\n");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.err, HasSubstr("MOTION/1 refers to JOINT/1, which a command has deactivated [inactive-joint]"));
}

TEST_F(EditCommands, the_message_file_says_what_was_taken_out) {
  const RunResult r = run(oscillator + "!     adams_view_name='lock'\nJOINT/2, FIXED, I=20, J=1\nEND\n",
                          "DEACTIVATE/JOINT, ID=2\nLINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.message,
              HasSubstr("Deactivated JOINT/2 (lock), force/torque values will be zero in function-expression "
                        "references."));
}

TEST_F(EditCommands, list_and_preferences_change_nothing) {
  const RunResult r = run(oscillator + "END\n",
                          "LINEAR/EIGENSOL\nPREFERENCES/SOLVER=F77\nSPRINGDAMPER/1, LIST\nLINEAR/"
                          "EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("ORIGINAL"));
  expect_frequency(r, 3, 2);
}

}  // namespace
}  // namespace dynalin::cases::edit_commands_test

// The warning that a point accelerates or turns: where something is out of balance, however stiff the model is, and
// nowhere else.
#include <gmock/gmock.h>

#include "cases/fe_parts.h"
#include "cases/flexible.h"
#include "cases/run.h"

namespace dynalin::cases::motion_caution_test {
namespace {

class MotionCaution : public Cases {
 protected:
  std::string remarks(const std::string& model, const std::string& commands = "LINEAR/EIGENSOL\n") const {
    const RunResult r = run(model, commands);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.err;
  }
  static constexpr const char* code = "accelerating-point";
};

const std::string gravity = "ACCGRAV/KGRAV=-9.81\n";

}  // namespace

TEST_F(MotionCaution, of_a_fall_that_stiff_modes_would_hide) {
  const std::string pair =
      "Pair\nUNITS/SYSTEM=MKS\n" + gravity +
      "PART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
      "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\nBUSHING/1, I=20, J=30, K=1E12,1E12,1E12, KT=1E12,1E12,1E12\nEND\n";
  EXPECT_THAT(remarks(pair), ::testing::HasSubstr("most of all PART/2 (acceleration of its mass centre 9.81 meter/s²"));
}

// A slow turn beside modes of megahertz.
TEST_F(MotionCaution, of_a_turn_that_stiff_modes_would_hide) {
  const std::string rotor =
      "Rotor\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1, WZ=1\nMARKER/20\n"
      "BUSHING/1, I=20, J=1, K=1E12,1E12,1E12, KT=1E12,1E12,0\nEND\n";
  EXPECT_THAT(remarks(rotor), ::testing::HasSubstr("angular velocity 1 rad/s"));
}

// What is left of the balance of a stiff beam is rounding, loaded or not.
TEST_F(MotionCaution, is_not_of_rounding) {
  StraightBeam beam;
  beam.E = 2.1e11, beam.density = 7800;
  std::string model = clamped_beam(beam);
  EXPECT_THAT(remarks(model), ::testing::Not(::testing::HasSubstr(code)));
  model.insert(model.find("PART/1"), gravity);
  EXPECT_THAT(remarks(model), ::testing::HasSubstr(code));
  EXPECT_THAT(remarks(model, "SIMULATE/STATICS\nLINEAR/EIGENSOL\n"), ::testing::Not(::testing::HasSubstr(code)));
}

// The frame of the body is held at its first node; a mass on its second one begins to sink with the mode.
TEST_F(MotionCaution, of_a_shape_that_accelerates) {
  const std::vector<FlexibleNode> nodes = {{1, {0, 0, 0}, 1, {1, 1, 1}, {{0, 0, 0}}, {{0, 0, 0}}},
                                           {2, {1, 0, 0}, 2, {1, 1, 1}, {{0, 0, 1}}, {{0, 0, 0}}}};
  write("body.fem", modal_text(nodes, Eigen::MatrixXd::Constant(1, 1, 800)));
  const std::string model =
      "Sag\nUNITS/SYSTEM=MKS\n" + gravity +
      "PART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=body.fem\nMARKER/21, FLEX_BODY=2, NODE_ID=1\n"
      "JOINT/1, FIXED, I=21, J=1\nEND\n";
  EXPECT_THAT(remarks(model), ::testing::HasSubstr("of a coordinate of its shape 9.81)"));
  EXPECT_THAT(remarks(model, "SIMULATE/STATICS\nLINEAR/EIGENSOL\n"), ::testing::Not(::testing::HasSubstr(code)));
}

// Bent and free: what is left of the acceleration of its mass centre is rounding, and looks like none.
TEST_F(MotionCaution, has_no_rounding_among_its_numbers) {
  const std::vector<FlexibleNode> nodes = {{1, {0, 0, 0}, 0.7, {.1, .1, .1}, {{0.3, 0.1, 0}}, {{0, 0, 0}}},
                                           {2, {1, 0, 0}, 0.3, {.1, .1, .1}, {{0.7, -0.2, 0}}, {{0, 0, 0}}},
                                           {3, {2, 0.3, 0}, 0.6, {.1, .1, .1}, {{-0.1, 0.9, 0.4}}, {{0, 0, 0}}}};
  write("body.fem", modal_text(nodes, Eigen::MatrixXd::Constant(1, 1, 90)));
  for (const std::string at : {"DMODE=0.1", "DMODE=0.07, REULER=0.3,0.4,0.5", "DMODE=1E-9, REULER=0.3,0.4,0.5"}) {
    const std::string model =
        "Free\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nFLEX_BODY/2, MNF_FILE=body.fem, " + at + "\nEND\n";
    EXPECT_THAT(remarks(model), ::testing::HasSubstr("(acceleration of its mass centre 0 meter/s², angular velocity 0 "
                                                     "rad/s, angular acceleration"))
        << at;
  }
}

// At the place of rest, and yet a damper or friction brakes it; a body without mass creeps.
TEST_F(MotionCaution, of_what_velocities_do) {
  const std::string ground = "Moves\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/11, REULER=90D,90D,0\n",
                    slides =
                        "PART/2, MASS=2, CM=20, IP=1,1,1, VX=1\nMARKER/20\nMARKER/21, REULER=90D,90D,0\n"
                        "JOINT/1, TRANSLATIONAL, I=21, J=11\n";
  for (const std::string braked : {"BUSHING/1, I=20, J=1, K=8,8,8, KT=1,1,1, C=1,1,1\n",
                                   "VFORCE/1, I=20, JFLOAT=19, RM=1, FX=-TANH(VX(20))\\FY=0\\FZ=0\n"
                                   "MARKER/19, PART=1, FLOATING\n"})
    EXPECT_THAT(remarks(ground + slides + braked + "END\n"),
                ::testing::HasSubstr("most of all PART/2 (acceleration of its mass centre 0."))
        << braked;
  const std::string creeps =
      "PART/2\nMARKER/20\nMARKER/21, REULER=90D,90D,0\nPART/3, MASS=1, CM=30, IP=1,1,1, QG=2,0,0\n"
      "MARKER/30\nMARKER/31, REULER=90D,90D,0\nJOINT/1, TRANSLATIONAL, I=21, J=11\n"
      "JOINT/2, TRANSLATIONAL, I=31, J=11\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=30, K=4, C=0.5, LENGTH=1\n"
      "SPRINGDAMPER/2, TRANSLATIONAL, I=30, J=12, K=4, C=0.5, LENGTH=1\nMARKER/12, PART=1, QP=3,0,0\n"
      "BUSHING/1, I=20, J=1, C=1,1,1\nEND\n";
  EXPECT_THAT(remarks(ground + creeps), ::testing::HasSubstr(code));
  // Held at its speed, whatever brakes it.
  EXPECT_THAT(remarks(ground + slides +
                      "BUSHING/1, I=20, J=1, C=7E8,7E8,7E8\nMOTION/1, JOINT=1, VELOCITY, FUNCTION=1\n"
                      "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\nBUSHING/3, I=30, J=1, K=9,9,9, KT=9,9,9\nEND\n"),
              ::testing::Not(::testing::HasSubstr(code)));
}

// No displacement brings to an end what a MOTION asks for.
TEST_F(MotionCaution, of_what_a_motion_accelerates) {
  const std::string driven =
      "Driven\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nPART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\n"
      "BUSHING/3, I=30, J=1, K=9,9,9, KT=9,9,9\nMOTION/1, JOINT=1, FUNCTION=";
  EXPECT_THAT(remarks(driven + "5*TIME**2\nEND\n"), ::testing::HasSubstr("angular acceleration 10 rad"));
  EXPECT_THAT(remarks(driven + "0.3\nEND\n"), ::testing::Not(::testing::HasSubstr(code)));
}

// Places have the digits that a dataset states, and those that an integration leaves.
TEST_F(MotionCaution, is_not_of_digits_that_nobody_states) {
  const auto held = [](const std::string& off) {
    return "Held\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, QP=1.2" + off +
           ",0,0\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, QP=1.2,0,0\n"
           "BUSHING/1, I=21, J=1, K=1E9,1E9,1E9, KT=1E9,1E9,1E9, C=1E4,1E4,1E4, CT=1E4,1E4,1E4\nEND\n";
  };
  EXPECT_THAT(remarks(held("0000000004")), ::testing::Not(::testing::HasSubstr(code)));
  EXPECT_THAT(remarks(held("000000004")), ::testing::HasSubstr(code));
  const std::string swings =
      "Swings\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10\nPART/1, GROUND\nMARKER/1\nMARKER/11, QP=0,1,0\n"
      "PART/2, MASS=1, CM=20, IP=1,1,1, WZ=0.1\nMARKER/20, QP=0,-1,0\nMARKER/21\n"
      "JOINT/1, REVOLUTE, I=21, J=1\nSFORCE/1, ROTATIONAL, I=21, J=1, FUNCTION=-2*WZ(21,1)\nEND\n";
  EXPECT_THAT(remarks(swings, "SIMULATE/DYNAMICS, END=30, STEPS=30\nLINEAR/EIGENSOL\n"),
              ::testing::Not(::testing::HasSubstr(code)));
  EXPECT_THAT(remarks(swings, "SIMULATE/DYNAMICS, END=12, STEPS=30\nLINEAR/EIGENSOL\n"), ::testing::HasSubstr(code));
  // ERROR of a command says how many, as that of the dataset does.
  EXPECT_THAT(remarks(swings, "INTEGRATOR/ERROR=1E-8\nSIMULATE/DYNAMICS, END=30, STEPS=30\nLINEAR/EIGENSOL\n"),
              ::testing::HasSubstr(code));
  EXPECT_THAT(remarks(swings, "SIMULATE/DYNAMICS, END=18, STEPS=18\nLINEAR/EIGENSOL\n"), ::testing::HasSubstr(code));
  EXPECT_THAT(remarks(swings, "INTEGRATOR/ERROR=1E-2\nSIMULATE/DYNAMICS, END=18, STEPS=18\nLINEAR/EIGENSOL\n"),
              ::testing::Not(::testing::HasSubstr(code)));
}

// Forces that all but cancel hide no acceleration that would be seen without them.
TEST_F(MotionCaution, of_a_small_part_of_large_forces) {
  const auto between = [](const std::string& preload, const std::string& place) {
    return "Between\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/2, QP=0,0,2\nPART/2, MASS=1, CM=20, IP=1,1,1, "
           "QG=0,0," +
           place +
           "\nMARKER/20\nJOINT/1, TRANSLATIONAL, I=20, J=1\nSPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=340, LENGTH=" +
           preload + "\nSPRINGDAMPER/2, TRANSLATIONAL, I=20, J=2, K=340, LENGTH=" + preload + "\nEND\n";
  };
  for (const std::string preload : {"1", "29412.76", "2.9E8"}) {
    EXPECT_THAT(remarks(between(preload, "1.02")), ::testing::HasSubstr("acceleration of its mass centre 13.6 meter"))
        << preload;
    EXPECT_THAT(remarks(between(preload, "1")), ::testing::Not(::testing::HasSubstr(code))) << preload;
  }
  // What digits of the preload do, beside none.
  EXPECT_THAT(remarks(between("29412.76", "1.000001")), ::testing::Not(::testing::HasSubstr(code)));
  EXPECT_THAT(remarks(between("1", "1.000001")), ::testing::HasSubstr(code));
}

// Nodes have their states along global axes whatever RM says.
TEST_F(MotionCaution, of_a_moving_reference_names_what_is_not_seen_from_it) {
  const std::string rotor =
      "Rotor\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n"
      "JOINT/1, REVOLUTE, I=20, J=1\nMOTION/1, JOINT=1, FUNCTION=5*TIME\n";
  const std::string blade =
      "MATERIAL/1, YOUNGS_MODULUS=7E10, POISSONS_RATIO=0.3, DENSITY=2700\n"
      "FE_PART/3, TYPE=3DBEAM, MATERIAL=1, NODE_LABELS=1,2,3, X=0,1,2, AREA=2E-3, IYY=1E-7, IZZ=6E-6, IXX=5E-7\n"
      "MARKER/30, FE_PART=3, NODE_LABEL=1\nJOINT/2, FIXED, I=30, J=20\n";
  const std::string body = "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30\nBUSHING/3, I=30, J=20, K=9,9,9, KT=9,9,9\n";
  const std::string except = "but for nodes of FE_PART/3, whose states are displacements along global axes";
  EXPECT_THAT(remarks(rotor + blade + "END\n", "LINEAR/EIGENSOL, RM=20\n"), ::testing::HasSubstr(except));
  const std::string of_body = remarks(rotor + body + "END\n", "LINEAR/EIGENSOL, RM=20\n");
  EXPECT_THAT(of_body, ::testing::HasSubstr("[moving-reference]"));
  EXPECT_THAT(of_body, ::testing::Not(::testing::HasSubstr("but for nodes")));
}

// Matrices hold for an instant as eigenvalues do.
TEST_F(MotionCaution, of_matrices) {
  const std::string pendulum =
      "Pendulum\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\n"
      "PART/1, GROUND\nMARKER/1\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, QP=1,0,0\nMARKER/21\n"
      "JOINT/1, REVOLUTE, I=21, J=1\nEND\n";
  for (const std::string option : {"STATEMAT, FILE=a", "MKB, FILE=a", "STATEMAT, FILE=a, DESCRIPTOR"})
    EXPECT_THAT(remarks(pendulum, "LINEAR/" + option + "\n"),
                ::testing::HasSubstr("the matrices hold for this instant"))
        << option;
  EXPECT_THAT(remarks(pendulum, "SIMULATE/STATICS\nLINEAR/STATEMAT, FILE=a\n"),
              ::testing::Not(::testing::HasSubstr(code)));
}

}  // namespace dynalin::cases::motion_caution_test

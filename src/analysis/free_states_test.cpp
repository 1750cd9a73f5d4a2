// Statics of states of which only a combination is free, as the pressures of a cylinder whose valve is shut at rest.
#include <gmock/gmock.h>

#include <cmath>

#include "analysis/statics.h"
#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::free_states_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A boom of 900 kg on a hinge along y. Its cylinder has chambers at the pressures DIF(1) and DIF(2), and a valve lets
// `flow` in where the length is not the one that is asked for.
const std::string hinged_boom =
    "ACCGRAV/KGRAV=-9.81\nMARKER/10, PART=1, REULER=0,90D,0\nMARKER/11, PART=1, QP=0.3,0,-0.4\n"
    "PART/2, MASS=900, CM=20, IP=300,1500,1500\nMARKER/20, QP=2.5,0,0.2\nMARKER/21, REULER=0,90D,0\n"
    "MARKER/22, QP=2,0,-0.1\nJOINT/1, REVOLUTE, I=21, J=10\n";
std::string asked_length(double length) {
  return "VARIABLE/11, FUNCTION=5E-3*(" + std::to_string(length) + "-DM(22,11))\n";
}
std::string boom(const std::string& flow, double length, const std::string& leak = "0") {
  return hinged_boom + "DIFF/1, IC=1.8E6, FUNCTION=1.4E9/(2E-2*(DM(22,11)-1.2)+1E-3)*(" + flow +
         "-2E-2*VR(22,11))\n"
         "DIFF/2, IC=1E5, FUNCTION=1.4E9/(1.2E-2*(3-DM(22,11))+1E-3)*(1.2E-2*VR(22,11)-0.6*" +
         flow + ")+" + leak +
         "\nSFORCE/1, TRANSLATIONAL, I=22, J=11, FUNCTION=DIF(1)*2E-2-DIF(2)*1.2E-2-5000*VR(22,11)\n" +
         asked_length(length);
}
std::string transfer(const std::string& denominator) {
  return "ARRAY/1, U, VARIABLES=11\nARRAY/2, X\nARRAY/3, Y\nTFSISO/1, X=2, U=1, Y=3, NUM=1, DEN=" + denominator + "\n";
}

double length_of(const OperatingPoint& op) {
  const Pose& pose = op.poses[1];
  return norm(pose.r + pose.R * Vector{2, 0, -0.1} - Vector{0.3, 0, -0.4});
}

struct Rest {
  std::shared_ptr<const System> system;
  StaticsReport report{};
  Findings findings{};
  Result<OperatingPoint> op;

  explicit Rest(const std::string& text) : system(system_of(text)), op(from(system->drawn())) {}
  Result<OperatingPoint> from(OperatingPoint start) {
    report = {};
    return find_equilibrium(*system, std::move(start), {}, report, findings);
  }
};

TEST(FreeStates, a_cylinder_rests_where_its_valve_is_shut) {
  const std::string chain =
      "VARIABLE/12, FUNCTION=VARVAL(11)\nVARIABLE/13, FUNCTION=VARVAL(12)+VARVAL(11)-VARVAL(12)\n";
  const std::pair<std::string, std::string> valves[] = {
      {"VARVAL(11)", ""},
      {"VARVAL(13)", chain},
      {"ARYVAL(3,1)", transfer("1")},
      {"ARYVAL(3,1)", transfer("1,0.02")},
      {"ARYVAL(3,1)", transfer("1,0.02,0.0002")},
      {"ARYVAL(3,1)",
       "ARRAY/1, U, VARIABLES=11\nARRAY/2, X\nARRAY/3, Y\nLSE/1, X=2, U=1, Y=3, A=1, B=2, C=3\n"
       "MATRIX/1, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=-50\nMATRIX/2, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=50\n"
       "MATRIX/3, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1\n"},
      {"DIF(3)", "DIFF/3, FUNCTION=50*(VARVAL(11)-DIF(3))\n"},
      {"DIF(3)", "DIFF/3, IMPLICIT, FUNCTION=DIF1(3)-50*(VARVAL(11)-DIF(3))\n"},
  };
  for (const auto& [flow, valve] : valves) {
    for (const double length : {1.7, 1.8, 1.9, 2.1}) {
      Rest rest(boom(flow, length) + valve);
      ASSERT_TRUE(rest.op) << rest.op.error().message << flow << valve << length;
      EXPECT_NEAR(length_of(*rest.op), length, 1e-14) << valve;
      EXPECT_LE(rest.report.imbalance, 1e-9);
      EXPECT_LT(rest.report.iterations, 40) << valve << length;
    }
  }
}

// Both pressures as states of one LSE, of constant volumes.
TEST(FreeStates, integrators_of_one_element_rest_where_their_input_vanishes) {
  Rest rest(hinged_boom + asked_length(1.9) +
            "ARRAY/1, U, VARIABLES=11\nARRAY/2, X\nARRAY/4, IC, NUMBERS=1.8E6,1E5\n"
            "MATRIX/1, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=0,0,0,0\n"
            "MATRIX/2, FULL=RORDER, ROWS=2, COLUMNS=1, VALUES=9E10,-6E10\nLSE/1, X=2, U=1, A=1, B=2, IC=4\n"
            "SFORCE/1, TRANSLATIONAL, I=22, J=11, FUNCTION=ARYVAL(2,1)*2E-2-ARYVAL(2,2)*1.2E-2-5000*VR(22,11)\n");
  ASSERT_TRUE(rest.op) << rest.op.error().message;
  EXPECT_NEAR(length_of(*rest.op), 1.9, 1e-14);
  EXPECT_LT(rest.report.iterations, 40);
}

// Both pressures may be higher by what does not move the piston.
TEST(FreeStates, a_combination_that_is_free_keeps_its_value) {
  Rest rest(boom("ARYVAL(3,1)", 1.9) + transfer("1,0.02"));
  ASSERT_TRUE(rest.op) << rest.op.error().message;
  OperatingPoint higher = *rest.op;
  higher.state[0] += 1.2e6, higher.state[1] += 2e6;
  const auto there = rest.from(higher);
  ASSERT_TRUE(there) << there.error().message;
  EXPECT_NEAR(there->state[0], higher.state[0], 1e-6);
  EXPECT_NEAR(there->state[1], higher.state[1], 1e-6);
  EXPECT_LE(rest.report.iterations, 3);
}

// What nothing holds are coordinates: the integrators are determined, and go at once to where they balance.
TEST(FreeStates, integrators_beside_free_coordinates_are_not_held) {
  const std::string part =
      "ACCGRAV/KGRAV=-10\nMARKER/901, PART=1, FLOATING\nPART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\n";
  const std::string load = "VFORCE/1, I=20, JFLOAT=901, RM=1, FX=0\\FY=0\\FZ=-30*DIF(1)-100*(DZ(20)-0.1)";
  const std::string height = "\nDIFF/1, FUNCTION=DZ(20)-0.1\n";
  const std::string soft = "BUSHING/1, I=20, J=1, K=100,100,0, KT=10,10,0, C=1,1,1, CT=1,1,1\n";
  const std::string cart =
      "ACCGRAV/KGRAV=-10\nMARKER/12, PART=1, REULER=90D,90D,0\nPART/2, MASS=3, CM=20, IP=1,1,1\n"
      "MARKER/20, REULER=90D,90D,0\nMARKER/21, REULER=0,90D,0\nJOINT/1, TRANSLATIONAL, I=20, J=12\n"
      "PART/3, MASS=1, CM=30, IP=1,1,1\nMARKER/30, QP=0.2,0,1\nMARKER/31, REULER=0,90D,0\n"
      "JOINT/2, REVOLUTE, I=31, J=21\n"
      "SFORCE/1, ROTATIONAL, I=31, J=21, FUNCTION=-60*(AZ(31,21)-0.1)-10*WZ(31,21)-40*DIF(1)\n"
      "DIFF/1, FUNCTION=AZ(31,21)-0.1\n";
  const std::string two =
      "ACCGRAV/KGRAV=-10\nMARKER/29, PART=1, FLOATING\nMARKER/39, PART=1, FLOATING\n"
      "PART/2, MASS=0.9, CM=20, IP=1,1,1, QG=2,0.08,-0.09\nMARKER/20\nDIFF/1, FUNCTION=DZ(20)-0.97\n"
      "VFORCE/2, I=20, JFLOAT=29, RM=1, FX=-1.2*(DX(20)-2.1)\\FY=0\\FZ=-120*(DZ(20)-0.97)-35*DIF(1)\n"
      "PART/3, MASS=53, CM=30, IP=1,1,1, QG=3,0.9,0.26\nMARKER/30\nDIFF/2, FUNCTION=TANH(5*(DZ(30)-0.29))\n"
      "VFORCE/3, I=30, JFLOAT=39, RM=1, FX=-30*(DX(30)-3.1)\\FY=0\\FZ=-23*(DZ(30)-0.29)-74*DIF(2)\n";
  const std::pair<std::string, int> models[] = {
      {part + load + "-20*VZ(20)" + height, 10}, {part + soft + load + height, 10}, {cart, 60}, {two, 8}};
  for (const auto& [model, most] : models) {
    const Rest rest(model);
    ASSERT_TRUE(rest.op) << rest.op.error().message << model;
    EXPECT_LE(rest.report.iterations, most) << model;
  }
}

// Free coordinates of another part do not keep Newton's steps from states that are free.
TEST(FreeStates, states_are_found_as_soon_beside_free_coordinates) {
  const std::string beside =
      "MARKER/901, PART=1, FLOATING\nPART/4, MASS=1, CM=40, IP=1,1,1\nMARKER/40\n"
      "VFORCE/1, I=40, JFLOAT=901, RM=1, FX=0\\FY=0\\FZ=-30*DIF(5)-100*(DZ(40)-0.1)-20*VZ(40)\n"
      "DIFF/5, FUNCTION=DZ(40)-0.1\nBUSHING/1, I=40, J=1, K=100,100,0, C=1,1,1, CT=1,1,1, KT=10,10,";
  for (const std::string turning : {"10\n", "0\n"}) {
    const Rest rest(boom("VARVAL(11)", 1.9) + beside + turning);
    ASSERT_TRUE(rest.op) << rest.op.error().message;
    EXPECT_NEAR(length_of(*rest.op), 1.9, 1e-14);
    EXPECT_NEAR(rest.op->poses[2].r.z, 0.1, 1e-14);
    EXPECT_LT(rest.report.iterations, 80) << turning;
  }
}

// Newton's first step winds the integrator up: forces balance, and no step from there brings its input closer to zero.
TEST(FreeStates, a_search_from_an_integrator_that_is_wound_up_ends_soon) {
  const Rest rest(
      "ACCGRAV/KGRAV=-10\nMARKER/29, PART=1, FLOATING\nPART/2, MASS=19.18, CM=20, IP=1,1,1, "
      "QG=2,0,0.069\nMARKER/20\nDIFF/1, FUNCTION=TANH(5*(DZ(20)+0.764))\n"
      "BUSHING/1, I=20, J=1, K=100,100,0, KT=10,10,10\n"
      "VFORCE/2, I=20, JFLOAT=29, RM=1, FX=0\\FY=0\\FZ=-2551*(DZ(20)+0.764)-39.46*DIF(1)-255.1*VZ(20)\n");
  ASSERT_TRUE(rest.op) << rest.op.error().message;
  EXPECT_NEAR(rest.op->poses[1].r.z, -0.764, 1e-12);
  EXPECT_LE(rest.report.iterations, 30);
}

// The number is that of the point nearest to rest, not of the first.
TEST(FreeStates, what_does_not_come_to_rest_is_told_by_its_least_rate) {
  Rest rest(boom("VARVAL(11)", 1.9, "10"));
  ASSERT_FALSE(rest.op);
  EXPECT_THAT(rest.op.error().message, HasSubstr("does not come to rest, its rate is still "));
  EXPECT_THAT(rest.op.error().message, Not(HasSubstr("e+08")));
}

}  // namespace
}  // namespace dynalin::analysis_test::free_states_test

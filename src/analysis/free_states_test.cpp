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

// The number is that of the point nearest to rest, not of the first.
TEST(FreeStates, what_does_not_come_to_rest_is_told_by_its_least_rate) {
  Rest rest(boom("VARVAL(11)", 1.9, "10"));
  ASSERT_FALSE(rest.op);
  EXPECT_THAT(rest.op.error().message, HasSubstr("does not come to rest, its rate is still "));
  EXPECT_THAT(rest.op.error().message, Not(HasSubstr("e+08")));
}

}  // namespace
}  // namespace dynalin::analysis_test::free_states_test

// Forces along the line between two markers that are at one point: no force is one in any direction, and a multiple of
// the distance changes alike in all.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/run.h"

namespace dynalin::cases::missing_line_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A body of mass 2 and inertia 1 on stiffnesses of 100 and 50, with MARKER/20 on MARKER/1.
std::string mounted(const std::string& more, const std::string& of_part = "") {
  return "Mounted\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nMARKER/5, QP=1,0,0\nPART/2, MASS=2, CM=20, IP=1,1,1" +
         of_part + "\nMARKER/20\nBUSHING/1, I=20, J=1, K=100,100,100, KT=50,50,50\n" + more + "\nEND\n";
}
std::string sforce(const std::string& function) { return "SFORCE/9, TRANSLATIONAL, I=20, J=1, FUNCTION=" + function; }
constexpr const char* told = "the markers of SFORCE/9 coincide, its line of action has no direction";

class MissingLines : public Cases {
 protected:
  void expect_stiffness(const std::string& dataset, double added) const {
    const RunResult r = run(dataset, "LINEAR/EIGENSOL, STRAIN=1\n");
    ASSERT_EQ(r.status, 0) << r.err << dataset;
    const auto vibration = [](double k) { return std::complex(0.0, std::sqrt(k) / (2 * std::numbers::pi)); };
    const auto along = vibration((100 + added) / 2), about = vibration(50);
    expect_eigenvalues(r.eigenvalues(0), {about, about, about, along, along, along});
    EXPECT_THAT(r.err, Not(HasSubstr("kink"))) << dataset;
  }
};

TEST_F(MissingLines, of_no_force_are_none_that_matter) {
  for (const char* f : {"0", "IF(TIME-1:0,0,5)", "DM(20,1)**2", "7*DM(20,1)*DX(20,1)", "STEP(TIME,0,0,1,1)"})
    expect_stiffness(mounted(sforce(f)), 0);
  expect_stiffness(mounted("VARIABLE/7, FUNCTION=0\n" + sforce("VARVAL(7)")), 0);
  expect_stiffness(mounted("CABLE/9, MARKERS=5,20,1, K=10, LENGTH=3"), 0);
}

TEST_F(MissingLines, of_a_multiple_of_the_distance_are_those_of_a_spring) {
  expect_stiffness(mounted("SPRINGDAMPER/9, TRANSLATIONAL, I=20, J=1, K=3"), 3);
  for (const char* f : {"-3*DM(20,1)", "-3*DM(1,20)", "-2*DM(20,1)-DM(1,20)", "-3*SIN(DM(20,1))", "DM(20,1)*(TIME-3)",
                        "5-5*EXP(0.6*DM(20,1))"})
    expect_stiffness(mounted(sforce(f)), 3);
}

// At 0.3 − 0.3 in one sum and not in the other.
TEST_F(MissingLines, are_missing_to_rounding) {
  const std::string apart =
      "MARKER/22, PART=1, QP=0.1,0,0\nMARKER/23, PART=2, QP=-0.2,0,0\nSFORCE/9, TRANSLATIONAL, "
      "I=23, J=22, FUNCTION=";
  const auto run_of = [&](const std::string& f) {
    return run(
        "t\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0.3,0,0\nMARKER/20\n" +
            apart + f + "\nEND\n",
        "LINEAR/STATEMAT, FILE=m\n");
  };
  const RunResult spring = run_of("-3*DM(23,22)"), push = run_of("1");
  ASSERT_EQ(spring.status, 0) << spring.err;
  double trace = 0;
  const auto A = spring.matrix(0, "A");
  for (const auto& row : A)
    for (const double a : row) trace += a == -1.5 ? 1 : 0;
  EXPECT_EQ(trace, 3);  // 3/2 in all directions
  EXPECT_EQ(push.status, 2);
  EXPECT_THAT(push.err, HasSubstr("the markers of SFORCE/9 coincide"));
}

TEST_F(MissingLines, of_what_varies_otherwise_leave_it_without_a_derivative) {
  for (const char* f : {"-2*VR(20,1)", "-2*VM(20,1)", "-3*DX(20,1)", "SQRT(DM(20,1))", "-DM(20,5)+1", "-3*AZ(20,1)"}) {
    const RunResult still =
        run(mounted(sforce(f)), "SIMULATE/INITIAL_CONDITIONS\nSIMULATE/STATICS\nSIMULATE/DYNAMICS, END=0.1, STEPS=1\n");
    EXPECT_EQ(still.status, 0) << still.err << f;
    const RunResult linear = run(mounted(sforce(f)), "LINEAR/EIGENSOL\n");
    EXPECT_EQ(linear.status, 2) << f;
    EXPECT_THAT(linear.err, AllOf(HasSubstr(told), HasSubstr("[undefined-derivative]"))) << f;
  }
  const RunResult damper =
      run(mounted("SPRINGDAMPER/9, TRANSLATIONAL, I=20, J=1, K=3, C=1"), "SIMULATE/STATICS\nLINEAR/EIGENSOL\n");
  EXPECT_EQ(damper.status, 2);
  EXPECT_THAT(damper.err, AllOf(HasSubstr("LINEAR/EIGENSOL failed"),
                                HasSubstr("the markers of SPRINGDAMPER/9 coincide, its line of action has no direction "
                                          "[undefined-derivative]")));
}

TEST_F(MissingLines, of_a_force_stop_the_analysis_by_name) {
  for (const char* f : {"5", "IF(TIME-1:5,5,0)", "1E-30", "DM(20,1)-1"}) {
    for (const char* command : {"SIMULATE/INITIAL_CONDITIONS\n", "SIMULATE/STATICS\n", "LINEAR/EIGENSOL\n"}) {
      const RunResult r = run(mounted(sforce(f)), command);
      EXPECT_EQ(r.status, 2) << f << command;
      EXPECT_THAT(r.err, HasSubstr(told)) << f << command;
    }
  }
  // A damper is a force there if the markers only pass.
  const RunResult passing =
      run(mounted("SPRINGDAMPER/9, TRANSLATIONAL, I=20, J=1, C=1", ", VX=1"), "SIMULATE/INITIAL_CONDITIONS\n");
  EXPECT_EQ(passing.status, 2);
  EXPECT_THAT(passing.err, HasSubstr("the markers of SPRINGDAMPER/9 coincide"));
}

// The force that others read changes as the one that acts.
TEST_F(MissingLines, are_the_same_to_who_reads_the_force) {
  const RunResult r =
      run(mounted(sforce("-3*DM(20,1)") + "\nVARIABLE/7, FUNCTION=SFORCE(9,0,2,1)\nPOUTPUT/1, VARIABLES=7"),
          "LINEAR/STATEMAT, POUTPUT=1, FILE=m\n");
  ASSERT_EQ(r.status, 0) << r.err;
  std::map<std::string, double> by;
  for (std::size_t k = 0; k < r.labels(0).size(); ++k)
    if (const double c = r.matrix(0, "C")[0][k]; c != 0) by[r.labels(0)[k]] = c;
  EXPECT_EQ(by, (std::map<std::string, double>{{"Global displacement DX(BCS) PART/2", -3}}));
}

TEST_F(MissingLines, are_warned_of) {
  const RunResult r = run(mounted(sforce("0")), "SIMULATE/INITIAL_CONDITIONS\n");
  EXPECT_THAT(r.err, HasSubstr("warning: MARKER/20 and MARKER/1 are drawn at one point: the line of action of SFORCE/9 "
                               "has no direction there [no-line-of-action]"));
  for (const char* element : {"SPRINGDAMPER/9, TRANSLATIONAL, I=20, J=1, K=3",
                              "SFORCE/9, ROTATIONAL, I=20, J=1, "
                              "FUNCTION=0",
                              "SFORCE/9, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=0"})
    EXPECT_THAT(run(mounted(element), "SIMULATE/INITIAL_CONDITIONS\n").err, Not(HasSubstr("no-line-of-action")));
}

}  // namespace
}  // namespace dynalin::cases::missing_line_test

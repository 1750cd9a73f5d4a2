// What compiled routines read of a model beside measures: splines, curves, texts, gravity.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "routines/with_libraries.h"

namespace dynalin::cases::data_utilities_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A body that may go anywhere, pulled along x. DX and DY of 20 are 0.3 and -0.2.
const std::string pulled = R"(pulled
UNITS/SYSTEM=MKS
ACCGRAV/IGRAV=0.1, JGRAV=-0.2, KGRAV=0.3
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, REULER=90D,90D,0D
PART/2, QG=0.3,-0.2,0, MASS=2, CM=20, IP=1,2,3, VX=0.4, VY=0.1
MARKER/20, PART=2
SPLINE/7, X=-1,-0.5,0,0.4,1,2, Y=-70,-20,0,19,83,100
SPLINE/8, X=-1,0,0.4,1,2, Y=-1, -60,0,20,75,90, Y=1, -30,3,11,50,200
STRING/1, STRING=against
MATRIX/1, FULL, RORDER, ROWS=4, COLUMNS=3, VALUES=-1,0,0, 0,2,1, 1,0,2, 3,1,0
CURVE/1, OPEN, MATRIX=1
)";
const std::string force = "SFORCE/1, TRANSLATION, ACTIONONLY, I=20, J=2, FUNCTION=";

class DataOfRoutines : public WithLibraries {
 protected:
  // The value of a VARIABLE, the VARIABLE being FUNCTION= of the text.
  double value(const std::string& function) const {
    const RunResult r = with(pulled + "VARIABLE/1, FUNCTION=" + function + "\nREQUEST/1, VARIABLES=1\n", {C_ROUTINES},
                             true, {"SIMULATE/INITIAL"});
    return requested(r, 0).at(0);
  }
};

TEST_F(DataOfRoutines, has_splines_with_their_derivatives) {
  struct Row {
    const char *of, *method;
  };
  for (const Row& row : {Row{"7", "0"}, Row{"7", "1"}, Row{"8", "0"}, Row{"8", "1"}}) {
    const std::string constants = fmt::format("USER({},{},20,1,3), ROUTINE=", row.of, row.method);
    const RunResult expected = with(pulled + force + "-" + (row.method[0] == '0' ? "AKISPL" : "CUBSPL") +
                                        "(DX(20,1,1), 3*DY(20,1,1), " + row.of + ")\n",
                                    {C_ROUTINES});
    for (const char* routine : {"routines::of_a_spline", "formulas::spline_by_formula"}) {
      const RunResult r = with(pulled + force + constants + routine + "\n", {C_ROUTINES, CPP_ROUTINES});
      expect_same(r, expected, 1e-13);
      EXPECT_THAT(r.err, AllOf(Not(HasSubstr("differenced-routine")), Not(HasSubstr("wrong-derivative"))));
    }
  }
}

// Rates of what a formula makes of a spline: y′ = s′ x′, y″ = s″ x′² + s′ x″.
TEST_F(DataOfRoutines, go_along_a_motion_in_formulas) {
  const std::string of_rate =
      "VARIABLE/2, FUNCTION=DIF1(1)\nDIFF/1, IMPLICIT, FUNCTION=DIF(1)-VARVAL(1)\n"
      "SFORCE/2, TRANSLATION, ACTIONONLY, I=20, J=2, FUNCTION=-0.1*VARVAL(2)\n";
  for (const char* of : {"7", "8"}) {
    const RunResult called =
        with(pulled + "VARIABLE/1, FUNCTION=USER(" + of + ",1,20,1,3), ROUTINE=formulas::spline_by_formula\n" + of_rate,
             {CPP_ROUTINES});
    expect_same(
        called,
        with(pulled + "VARIABLE/1, FUNCTION=-CUBSPL(DX(20,1,1), 3*DY(20,1,1), " + of + ")\n" + of_rate, {CPP_ROUTINES}),
        1e-13);
  }
}

TEST_F(DataOfRoutines, has_second_derivatives) {
  for (const int method : {0, 1}) {
    const auto derivative = [&](int number) {
      return value(fmt::format("USER({},8,{}), ROUTINE=routines::of_the_data", method, number));
    };
    const auto expression = [&](const char* arguments) {
      return value(fmt::format("{}({})", method == 0 ? "AKISPL" : "CUBSPL", arguments));
    };
    EXPECT_NEAR(derivative(0), expression("1.5,0.5,8,2"), 1e-10);
    // Linear in z, from -1 to 1.
    EXPECT_NEAR(derivative(1), 0.5 * (expression("1.5,1,8,1") - expression("1.5,-1,8,1")), 1e-10);
    EXPECT_EQ(derivative(2), 0);
  }
}

TEST_F(DataOfRoutines, has_curves_texts_and_gravity) {
  const auto of = [&](int what, int number) {
    return value(fmt::format("USER({},1,{}), ROUTINE=routines::of_the_data", what, number));
  };
  for (int order = 0; order < 3; ++order) {
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(of(2 + order, k), value(fmt::format("CURVE(0.25,{},{},1)", order, k + 1)), 1e-12) << order << k;
  }
  EXPECT_EQ(of(5, 0), 0.1);
  EXPECT_EQ(of(5, 1), -0.2);
  EXPECT_EQ(of(5, 2), 0.3);
  const std::string text = "against";
  for (std::size_t k = 0; k < text.size(); ++k) EXPECT_EQ(of(6, static_cast<int>(k)), text[k]);
  EXPECT_EQ(of(7, 0), 7);
}

TEST_F(DataOfRoutines, has_texts_before_anything_is_evaluated) {
  std::string named = pulled;
  named.replace(named.find("STRING=against"), 14, "STRING=VX");
  expect_same(with(named + force + "USER(1,20,1), ROUTINE=routines::named_by_text\n", {C_ROUTINES}),
              with(pulled + force + "-5*VX(20,1,1)\n", {C_ROUTINES}), 1e-13);
}

TEST_F(DataOfRoutines, has_them_in_fortran) {
#ifdef FORTRAN_FRICTION
  const std::string call = force + "USER(7,20,1), ROUTINE=fortran_friction::of_a_spline\n";
  expect_same(with(pulled + call, {FORTRAN_FRICTION}),
              with(pulled + force + "-AKISPL(DX(20,1,1),0,7)+CURVE(0,0,3,1)\n", {FORTRAN_FRICTION}), 1e-13);
#else
  GTEST_SKIP() << "no Fortran compiler";
#endif
}

TEST_F(DataOfRoutines, follow_what_commands_make_of_them) {
  const std::string call = force + "USER(7,0,20,1,0), ROUTINE=routines::of_a_spline\n";
  const std::vector<std::string> commands = {"SPLINE/7, Y=-7,-2,0,1.9,8.3,10", "LINEAR/EIGENSOL"};
  std::string tenth = pulled;
  tenth.replace(tenth.find("Y=-70,-20,0,19,83,100"), 21, "Y=-7,-2,0,1.9,8.3,10");
  const RunResult edited = with(pulled + call, {C_ROUTINES}, false, commands);
  expect_same(edited, with(tenth + call, {C_ROUTINES}, false, commands), 1e-13, 1);
  EXPECT_GT(std::abs(edited.eigenvalues(1).back()), 0);
  const RunResult text = with(pulled +
                                  "VARIABLE/1, FUNCTION=USER(7,1,0), ROUTINE=routines::of_the_data\nREQUEST/1, "
                                  "VARIABLES=1\n",
                              {C_ROUTINES}, true, {"STRING/1, STRING=at", "SIMULATE/INITIAL"});
  EXPECT_EQ(requested(text, 1).at(0), 2);
}

TEST_F(DataOfRoutines, is_missed_by_name) {
  for (const char* call :
       {"USER(9,0,20,1,0), ROUTINE=routines::of_a_spline", "USER(9,1,20,1,0), ROUTINE=routines::of_a_spline",
        "USER(2,9,0), ROUTINE=routines::of_the_data", "USER(6,9,0), ROUTINE=routines::of_the_data"}) {
    const RunResult r = with(pulled + force + call + "\n", {C_ROUTINES}, true);
    EXPECT_NE(r.status, 0) << call;
    EXPECT_THAT(r.err, AllOf(HasSubstr("SFORCE/1"), HasSubstr("it says: there is no such s"))) << call;
  }
  EXPECT_NE(with(pulled + force + "USER(9,20,1), ROUTINE=formulas::spline_by_formula\n", {CPP_ROUTINES}).status, 0);
}

}  // namespace
}  // namespace dynalin::cases::data_utilities_test

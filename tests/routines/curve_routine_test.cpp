// CURVEs by compiled routines, against the same cubic through points, in C, Fortran and by formulas.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "cases/curves.h"
#include "routines/with_libraries.h"

namespace dynalin::cases::curve_routine_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> linear = {"LINEAR/EIGENSOL"}, statics = {"SIMULATE/STATICS", "LINEAR/EIGENSOL"};

class CurveRoutines : public WithLibraries {
 protected:
  RunResult with(const std::string& dataset, const std::vector<std::string>& commands = linear,
                 const std::vector<std::string>& libraries = {C_LOADS, CPP_LOADS}, bool differences = false) const {
    return WithLibraries::with(dataset, libraries, differences, commands);
  }
};

std::string coefficients(const Polynomials& p, double from = 0, double by = 1) {
  std::string s;
  for (const auto& row : p.a)
    for (const double a : row) s += fmt::format("{:.17g},", a);
  return s + fmt::format("{:.17g},{:.17g}", from, by);
}
std::string called(int id, const Polynomials& p, const std::string& routine = "") {
  return fmt::format("CURVE/{}, OPEN, FUNCTION=USER({})", id, coefficients(p)) +
         (routine.empty() ? "" : ", ROUTINE=" + routine) + "\n";
}
const Polynomials trough{{{{0, 1, 0, 0}, {0.1, 0.05, 0.9, 0.2}, {0, 0, 0, 0}}}};
const Polynomials table{{{{0, 1, 0, 0}, {0, 0, -0.2, 0.1}, {0, 0, 0, 0}}}};

const std::string head =
    "curves\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nMARKER/9, FLOATING\n";
std::string bead(const std::string& more = "") {
  return "PART/2, MASS=3, CM=2, IP=1,1,1, QG=0.2,0.2,-0.05\nMARKER/2\nPTCV/1, I=2, JFLOAT=9, CURVE=1, RM=1" + more +
         "\nBUSHING/1, I=2, J=1, K=1,2,3, KT=1,1,1\n";
}

TEST_F(CurveRoutines, beads_rest_on_them) {
  const RunResult expected = with(head + bow.curve(1, 6) + bead(), statics);
  for (const char* routine : {"", "loads::Cursubc", "load_formulas::cubic_by_formula"}) {
    const RunResult r = with(head + called(1, bow, routine) + bead(), statics);
    expect_same(r, expected, 1e-9, 1);
    EXPECT_THAT(r.err, AllOf(Not(HasSubstr("differenced")), Not(HasSubstr("wrong-derivative")))) << routine;
  }
#ifdef FORTRAN_LOADS
  expect_same(with(head + called(1, bow) + bead(), statics, {FORTRAN_LOADS}), expected, 1e-9, 1);
#endif
  // By another parameter, from 0 to 10.
  const std::string other = "CURVE/1, OPEN, MINPAR=0, MAXPAR=10, FUNCTION=USER(" + coefficients(bow, -1, 0.2) + ")\n";
  expect_same(with(head + other + bead(), statics), expected, 1e-9, 1);
}

// Where it moves a linear model has third derivatives in it, which an entry gives; and differences where they may.
TEST_F(CurveRoutines, beads_move_along_them) {
  const RunResult expected = with(head + bow.curve(1, 6) + bead(", VEL=1.3"));
  expect_same(with(head + called(1, bow, "load_formulas::cubic_by_formula") + bead(", VEL=1.3")), expected, 1e-10);
  const RunResult refused = with(head + called(1, bow) + bead(", VEL=1.3"));
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("PTCV/1"), HasSubstr("the routine cursub of"), HasSubstr("third"),
                                 HasSubstr("--difference-user-routines")));
  const RunResult differenced = with(head + called(1, bow) + bead(", VEL=1.3"), linear, {C_LOADS}, true);
  expect_same(differenced, expected, 1e-6);
  const std::string shown = "REQUEST/1, F2=DX(2,1)\\F3=DY(2,1)\\F4=VX(2,1)\\F6=ACCX(2,1)\\F7=ACCY(2,1)\n";
  const std::vector<std::string> run = {"SIMULATE/TRANSIENT, END=0.6, STEPS=6", "SIMULATE/INITIAL"};
  const auto a = requested(with(head + bow.curve(1, 6) + bead(", VEL=1.3") + shown, run), 1);
  for (const char* routine : {"", "load_formulas::cubic_by_formula"}) {
    const auto b = requested(with(head + called(1, bow, routine) + bead(", VEL=1.3") + shown, run), 1);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(b[k], a[k], 1e-4 * (1 + std::abs(a[k]))) << routine << k;
  }
}

// Tangents in the rows of a constraint make a linear model read third derivatives at rest.
TEST_F(CurveRoutines, curves_touch_curves_planes_and_axes) {
  const std::string wheel =
      "PART/2, MASS=2, CM=20, IP=1,1,0.4, QG=-0.0066,-0.095,0, REULER=-0.1765,0,0\nMARKER/20, "
      "QP=0,0.3,0\nMARKER/21\nMARKER/29, FLOATING\n"
      "JOINT/1, PLANAR, I=20, J=1\nSPRINGDAMPER/1, ROTATIONAL, I=20, J=1, KT=9\n"
      "SPRINGDAMPER/2, TRANSLATION, I=20, J=8, K=30, C=0.1, LENGTH=0.1\nMARKER/8, PART=1, QP=0.1,3,0\n";
  const std::string on_curve = "CVCV/1, IFLOAT=29, ICURVE=1, IRM=21, JFLOAT=9, JCURVE=2, JRM=1\n";
  const std::string along =
      "PART/2, MASS=3, CM=2, IP=1,2,3, QG=0.1,0.1,-0.1\nMARKER/2\nAXCV/1, I=2, JFLOAT=9, CURVE=1, RM=1\n"
      "BUSHING/1, I=2, J=1, K=10,20,30, KT=5,6,7\n";
  const std::string under_plane =
      "PART/2, MASS=2, CM=20, IP=1,1,0.4, QG=0,0.05,0, REULER=0.1,90D,0\nMARKER/20\nMARKER/29, PART=2, FLOATING\n"
      "MARKER/3, PART=1, REULER=0.1,90D,0\nBUSHING/1, I=20, J=3, K=10,20,30, KT=5,6,7\n"
      "PLCV/1, I=20, IFLOAT=29, JFLOAT=9, CURVE=1, RM=1\n";
  struct Row {
    std::string points, routine, model, name;
  };
  const auto formula = [](int id, const Polynomials& p) { return called(id, p, "load_formulas::cubic_by_formula"); };
  for (const Row& row :
       {Row{trough.curve(1, 6) + table.curve(2, 6), formula(1, trough) + formula(2, table), wheel + on_curve, "CVCV/1"},
        Row{bow.curve(1, 6), formula(1, bow), along, "AXCV/1"},
        Row{table.curve(1, 6), formula(1, table), under_plane, "PLCV/1"}}) {
    const RunResult expected = with(head + row.points + row.model, statics);
    // The wheel stands on the edge of where it rolls to, drawn a little beside.
    EXPECT_EQ(expected.err.find("[saddle]") != std::string::npos, row.name == "CVCV/1") << expected.err;
    expect_same(with(head + row.routine + row.model, statics), expected, 1e-8, 1);
    std::string plain = row.routine;
    for (std::size_t at = 0; (at = plain.find("load_formulas::cubic_by_formula")) != std::string::npos;)
      plain.replace(at, 31, "loads::cursub");
    const RunResult refused = with(head + plain + row.model, statics);
    EXPECT_EQ(refused.status, 2) << row.name;
    EXPECT_THAT(refused.err, AllOf(HasSubstr(row.name), HasSubstr("third"))) << row.name;
    const RunResult differenced = with(head + plain + row.model, statics, {C_LOADS}, true);
    expect_same(differenced, expected, 1e-6, 1);
    EXPECT_THAT(differenced.json.dump(), HasSubstr("null")) << row.name;  // no bounds
  }
}

// A bead on a closed circle goes round more than once, as the pendulum that it is.
TEST_F(CurveRoutines, closed_ones_repeat) {
  const std::string shown = "REQUEST/1, F2=DX(2,1)\\F3=DY(2,1)\\F4=VX(2,1)\n";
  const std::vector<std::string> run = {"SIMULATE/TRANSIENT, END=1.5, STEPS=10", "SIMULATE/INITIAL"};
  const std::string round = "POINT_MASS/2, MASS=3, CM=2, QG=0,-0.5,0, VX=7\nMARKER/2\n";
  const auto expected =
      requested(with("round\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=3, CM=2, "
                     "QG=0,-0.5,0, IP=1E-9,1E-9,1E-9, VX=7, WZ=14\nMARKER/2\nMARKER/22, QP=0,0.5,0\nJOINT/1, REVOLUTE, "
                     "I=22, J=1\n" +
                         shown,
                     run),
                1);
  for (const char* routine : {"loads::circle", "load_formulas::circle_by_formula"}) {
    const std::string curve =
        fmt::format("CURVE/1, CLOSED, MINPAR=0, MAXPAR=3, FUNCTION=USER(0.5,3), ROUTINE={}\n", routine);
    const auto found =
        requested(with(head + curve + round + "PTCV/1, I=2, JFLOAT=9, CURVE=1, RM=1, VEL=7\n" + shown, run), 1);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_NEAR(found[k], expected[k], 2e-3 * (1 + std::abs(expected[k]))) << routine << k;
  }
}

// What an expression and a marker at the contact read of them.
TEST_F(CurveRoutines, are_read_by_functions_and_markers) {
  const std::string readers =
      "SFORCE/1, TRANSLATION, ACTIONONLY, I=2, J=1, FUNCTION=-3*CURVE(DX(2,1),0,2,1)-CURVE(DX(2,1),1,3,1)\n"
      "SFORCE/2, TRANSLATION, ACTIONONLY, I=2, J=1, FUNCTION=-2*DX(9,1)-AZ(2,9)\n";
  const RunResult expected = with(head + bow.curve(1, 6) + bead() + readers, statics);
  expect_same(with(head + called(1, bow, "load_formulas::cubic_by_formula") + bead() + readers, statics), expected,
              1e-9, 1);
}

TEST_F(CurveRoutines, what_is_wrong_with_them_is_named) {
  EXPECT_THAT(with(head + called(1, bow, "wrong_slope") + bead()).err,
              AllOf(HasSubstr("wrong-derivative"), HasSubstr("CURVE/1"), HasSubstr("as derivative 1 of y")));
  EXPECT_THAT(with(head + called(1, bow, "wrong_bend") + bead()).err,
              AllOf(HasSubstr("wrong-derivative"), HasSubstr("as derivative 2 of z")));
  const auto said = [&](const std::string& curve) { return with(head + curve + "\n" + bead()).err; };
  EXPECT_THAT(said("CURVE/1, CLOSED, FUNCTION=USER(0.5,3), ROUTINE=circle"),
              AllOf(HasSubstr("curve-data"), HasSubstr("CURVE/1 is CLOSED")));
  EXPECT_THAT(said("CURVE/1, OPEN, MINPAR=2, FUNCTION=USER(0.5,3), ROUTINE=circle"),
              AllOf(HasSubstr("value-out-of-range"), HasSubstr("MINPAR")));
  EXPECT_THAT(said("CURVE/1, OPEN, FUNCTION=USER(0), ROUTINE=no_curve"),
              AllOf(HasSubstr("routine-failed"), HasSubstr("DX(20, 1)")));
  EXPECT_THAT(said("CURVE/1, OPEN, FUNCTION=USER(1), ROUTINE=no_curve"), HasSubstr("no such curve"));
  EXPECT_THAT(said("CURVE/1, OPEN, FUNCTION=USER(2), ROUTINE=no_curve"), HasSubstr("more than the three values"));
  EXPECT_THAT(said("CURVE/1, OPEN, FUNCTION=USER(3), ROUTINE=no_curve"), HasSubstr("no finite numbers"));
  EXPECT_THAT(said("MATRIX/1, FULL=RORDER, ROWS=4, COLUMNS=3, VALUES=1,2,3,4,5,6,7,8,9,1,2,4\nCURVE/1, OPEN, MATRIX=1, "
                   "FUNCTION=USER(0.5,3), ROUTINE=circle"),
              HasSubstr("excluded-arguments"));
  EXPECT_THAT(said("CURVE/1, OPEN, FUNCTION=3*TIME"), AllOf(HasSubstr("unknown-word"), HasSubstr("CURSUB")));
}

}  // namespace
}  // namespace dynalin::cases::curve_routine_test

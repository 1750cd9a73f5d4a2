// Routines without derivatives whose laws are other ones close to a point than further off: their linear models are
// those of the slope at the point, in whatever units, and derivatives that are given are not doubted for it.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>

#include "routines/with_libraries.h"

namespace dynalin::cases::differenced_routine_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class DifferencedRoutines : public WithLibraries {
 protected:
  RunResult with(const std::string& dataset, const std::vector<std::string>& commands = {"LINEAR/EIGENSOL"}) const {
    return WithLibraries::with(dataset, {C_LAWS, CPP_ROUTINES}, true, commands);
  }
  RunResult slider(const std::string& function, const std::vector<std::string>& commands = {"LINEAR/EIGENSOL"},
                   double length = 1) const {
    const std::string millimeters = "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n";
    return with("slider\n" + (length == 1 ? "UNITS/SYSTEM=MKS\n" : millimeters) +
                    "PART/1, GROUND\nMARKER/1\nMARKER/2, REULER=90D,90D,0D\nPART/2, MASS=2, CM=20, IP=1,1,1\n"
                    "MARKER/20\nMARKER/21, REULER=90D,90D,0D\nJOINT/1, TRANSLATIONAL, I=21, J=2\n"
                    "SFORCE/1, TRANSLATION, ACTIONONLY, I=21, J=2, FUNCTION=" +
                    function + "\n",
                commands);
  }
  static std::string law(int which, double a, bool of_speed, double stiffness = 0) {
    return fmt::format("USER({},{},{},{}), ROUTINE=laws::law_along", which, a, of_speed ? 1 : 0, stiffness);
  }
};

TEST_F(DifferencedRoutines, see_a_detent_in_whatever_units) {
  const RunResult spring = slider("-1E5*DX(20,1)");
  for (const double a : {0.05, 5e-4, 1e-5}) {
    expect_same(slider(law(0, a, false)), spring, 1e-9);
    const RunResult found = slider(law(0, a, false), {"SIMULATE/STATICS", "LINEAR/EIGENSOL"});
    ASSERT_EQ(found.status, 0) << found.err;
    EXPECT_NEAR(std::abs(found.eigenvalues(1).at(0)), std::abs(spring.eigenvalues(0).at(0)), 1e-6) << a;
    EXPECT_THAT(found.err, Not(HasSubstr("nothing holds")));
  }
  expect_same(slider(law(0, 0.5, false), {"LINEAR/EIGENSOL"}, 1e-3), slider("-1E5*DX(20,1)", {"LINEAR/EIGENSOL"}, 1e-3),
              1e-9);
}

TEST_F(DifferencedRoutines, see_friction_that_falls_with_small_speeds_and_cogging) {
  for (const double a : {1e-2, 1e-4, 1e-5})
    expect_same(slider(law(1, a, true)), slider(fmt::format("-({})*VX(20,1)", 10 + 2 / a)), 1e-9);
  for (const int n : {100, 512, 1024, 2048})
    expect_same(slider(law(2, 1.0 / n, false)), slider(fmt::format("-({})*DX(20,1)", 100 + 0.1 * std::numbers::pi * n)),
                1e-9);
}

TEST_F(DifferencedRoutines, have_no_slope_where_a_smooth_law_has_none) {
  const RunResult spring = slider("-50*DX(20,1)");
  for (const int which : {3, 4, 5}) expect_same(slider(law(which, 5, true, 50)), spring, 1e-9);
  expect_same(slider(law(6, 1e6, false, 50)), spring, 1e-6);
  const RunResult jump = slider(law(7, 5, true, 50));
  EXPECT_EQ(jump.status, 2);
  EXPECT_THAT(jump.err, HasSubstr("it jumps here"));
  const RunResult state = with(
      "state\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nVARIABLE/1, FUNCTION=0\nDIFF/1, IC=0, FUNCTION=USER(0), "
      "ROUTINE=laws::law_of_state\n");
  ASSERT_EQ(state.status, 0) << state.err;
  ASSERT_EQ(state.eigenvalues(0).size(), 1U);
  EXPECT_EQ(std::abs(state.eigenvalues(0)[0]), 0);
}

TEST_F(DifferencedRoutines, of_slip_are_that_of_the_smallest_one) {
  const auto ball = [&](const std::string& friction) {
    return with(
        "ball\nUNITS/SYSTEM=MKS\nACCGRAV/KGRAV=-10\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=2, "
        "IP=0.008,0.008,0.008, QG=0.2,0,0.099\nMARKER/2\nGRAPHICS/1, PLANE, RM=1, XMIN=-1, XMAX=1, YMIN=-1, "
        "YMAX=1\nGRAPHICS/2, ELLIPSOID, CM=2, XSCALE=0.2, YSCALE=0.2, ZSCALE=0.2\nCONTACT/1, IGEOM=2, JGEOM=1, "
        "IMPACT, STIFFNESS=2E5, EXPONENT=1.5, DAMPING=0, DMAX=0.001, FFUNCTION=USER(" +
            friction + "), FROUTINE=laws::law_of_slip\n",
        {"SIMULATE/STATICS", "LINEAR/EIGENSOL"});
  };
  for (const double a : {1e-4, 1e-5}) {
    const RunResult found = ball(fmt::format("1,{}", a));
    ASSERT_EQ(found.status, 0) << found.err;
    double fastest = 0;
    for (const auto& v : found.eigenvalues(1)) fastest = std::max(fastest, std::abs(v));
    // A ball that slips and rolls, pressed in by its weight: at the middle of the depth 1/m + r²/I.
    const double r = 0.1 - 0.5 * std::pow(20 / 2e5, 2.0 / 3), slip = (10 + 2 / a) * 20 * (1 / 2.0 + r * r / 0.008);
    EXPECT_NEAR(fastest, slip / (2 * std::numbers::pi), 1e-3 * fastest) << a;
  }
  const RunResult none = ball("4,0.3");
  EXPECT_EQ(none.status, 0) << none.err;
}

TEST_F(DifferencedRoutines, beside_exact_derivatives_do_not_doubt_them_for_what_is_near_or_lost) {
  for (const double a : {0.05, 5e-4, 1e-5}) {
    const RunResult detent = slider(fmt::format("USER({}), ROUTINE=formulas::detent_by_formula", a));
    expect_same(detent, slider("-1E5*DX(20,1)"), 1e-12);
    EXPECT_THAT(detent.err, Not(HasSubstr("wrong-derivative"))) << a;
  }
  const RunResult rest = with(
      "rest\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nVARIABLE/1, FUNCTION=0.7\nDIFF/1, IC=0.3, IMPLICIT, "
      "FUNCTION=USER(0), ROUTINE=formulas::implicit_by_formula\n",
      {"SIMULATE/STATICS", "LINEAR/EIGENSOL"});
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_THAT(rest.err, Not(HasSubstr("wrong-derivative")));
}

}  // namespace
}  // namespace dynalin::cases::differenced_routine_test

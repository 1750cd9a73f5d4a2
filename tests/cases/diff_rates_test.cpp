// DIF1 of algebraic DIFFs through splines and controllers, and DIFFs that are held in dynamics, against closed forms.
#include <gmock/gmock.h>

#include <numbers>

#include "cases/run.h"
#include "cases/study_of.h"

namespace dynalin::cases::diff_rates_test {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string z = "DZ(20,1,1)", v = "VZ(20,1,1)";

// A mass of 2 that slides along z with the force F on it, z = z0 and z′ = v0 at the start.
std::string slider(const std::string& force, const std::string& more, double z0 = 0, double v0 = 0) {
  return "A slider\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\nPART/2, MASS=2, CM=20, IP=1,1,1, QG=0,0," +
         std::to_string(z0) + ", VZ=" + std::to_string(v0) +
         "\nMARKER/20\nMARKER/10, PART=1, FLOATING\nJOINT/1, TRANSLATIONAL, I=20, J=1\n"
         "VFORCE/1, I=20, JFLOAT=10, RM=1, FX=0\\ FY=0\\ FZ=" +
         force + "\n" + more + "END\n";
}

class DiffRates : public Cases {
 protected:
  // The row of C for VARIABLE/1 at z = 3, z′ = 2; states z′, z, then those of controllers.
  std::vector<double> output_row(const std::string& more) const {
    const RunResult r =
        run(slider("0", more + "VARIABLE/9, FUNCTION=0\nPINPUT/1, VARIABLES=9\nPOUTPUT/1, VARIABLES=1\n", 3, 2),
            "LINEAR/STATEMAT, PINPUT=1, POUTPUT=1, FILE=s\n");
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? r.matrix(0, "C")[0] : std::vector<double>();
  }
  // 2 s² + k = 0 and nothing else.
  void expect_spring(double k, const std::string& dataset, const std::string& commands = "LINEAR/EIGENSOL\n") const {
    const RunResult r = run(dataset, commands);
    ASSERT_EQ(r.status, 0) << r.err;
    const auto s = r.eigenvalues(r.json.at("results").size() - 1);
    ASSERT_EQ(s.size(), 2u);
    EXPECT_NEAR(std::abs(s[0].imag()) * 2 * std::numbers::pi, std::sqrt(k / 2), 1e-12);
    EXPECT_NEAR(s[0].real(), 0, 1e-13);
  }
};

// The cubic spline through z² is z²: its rate 2 z z′ has the derivatives 2 z by z′ and 2 z′ by z.
TEST_F(DiffRates, rate_through_a_spline) {
  EXPECT_THAT(output_row("SPLINE/1, X=0,1,2,3.5,4,5, Y=0,1,4,12.25,16,25\n"
                         "DIFF/1, IMPLICIT, FUNCTION=DIF(1)-CUBSPL(" +
                         z + ",0,1)\nVARIABLE/1, FUNCTION=DIF1(1)\n"),
              ElementsAre(DoubleNear(6, 1e-12), DoubleNear(4, 1e-12)));
}

// (1 + 2 s)/(1 + s/2):  x′ = −2 x − 6 u, y = x + 4 u.  With u = z:  y′ = −2 x − 6 z + 4 z′.
const std::string controller =
    "TFSISO/1, U=1, X=2, Y=3, NUMERATOR=1,2, DENOMINATOR=1,0.5, IC=4\nARRAY/1, U, VARIABLES=2\nARRAY/2, X\nARRAY/3, Y\n"
    "ARRAY/4, IC, NUMBERS=0.5\nVARIABLE/2, FUNCTION=" +
    z + "\n";

TEST_F(DiffRates, rate_through_the_output_of_a_controller) {
  EXPECT_THAT(output_row(controller + "DIFF/1, IMPLICIT, FUNCTION=DIF(1)-ARYVAL(3,1)\nVARIABLE/1, FUNCTION=DIF1(1)\n"),
              ElementsAre(DoubleNear(4, 1e-13), DoubleNear(-6, 1e-13), DoubleNear(-2, 1e-13)));
}

// (x²)′ = 2 x x′ = −4 x² − 12 x z at x = 0.5, z = 3: −8 x − 12 z by x, −12 x by z.
TEST_F(DiffRates, rate_through_the_state_of_a_controller) {
  EXPECT_THAT(
      output_row(controller + "DIFF/1, IMPLICIT, FUNCTION=DIF(1)-ARYVAL(2,1)**2\nVARIABLE/1, FUNCTION=DIF1(1)\n"),
      ElementsAre(DoubleNear(0, 1e-13), DoubleNear(-6, 1e-13), DoubleNear(-40, 1e-12)));
}

// A straight line through points is 3 z, also where DIFFs that share rates hold a condition without them.
TEST_F(DiffRates, splines_stand_in_conditions) {
  const auto shared = [](const std::string& g) {
    return slider("-8*" + z + "+DIF(2)",
                  "DIFF/1, IMPLICIT, FUNCTION=DIF1(1)+DIF1(2)+2*DIF(1)-" + g +
                      "\nDIFF/2, IMPLICIT, FUNCTION=2*DIF1(1)+2*DIF1(2)+DIF(1)-2*DIF(2)-" + g +
                      "\nSPLINE/1, X=-2,-1,1,2, Y=-6,-3,3,6\n",
                  0.3, 0.2);
  };
  const RunResult a = run(shared("AKISPL(" + z + ",0,1)"), "LINEAR/EIGENSOL\n"),
                  b = run(shared("3*" + z), "LINEAR/EIGENSOL\n");
  ASSERT_EQ(a.status, 0) << a.err;
  ASSERT_EQ(b.status, 0) << b.err;
  const auto x = a.eigenvalues(0), y = b.eigenvalues(0);
  ASSERT_EQ(x.size(), 3u);
  ASSERT_EQ(y.size(), 3u);
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(std::abs(x[k] - y[k]), 0, 1e-12);
}

// Three times the first equation less the second one has no rates: 2 z₁ = 0, and 0.9 − 3 · 0.3 is rounding.
TEST_F(DiffRates, coefficients_that_cancel_but_for_rounding_are_in_no_condition) {
  const RunResult r =
      run("Rates\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1\n"
          "DIFF/1, IC=0, IMPLICIT, FUNCTION=0.1*DIF1(1)+0.7*DIF1(2)+DIF(1)+0.3*DIF(2)\n"
          "DIFF/2, IC=1, IMPLICIT, FUNCTION=0.3*DIF1(1)+2.1*DIF1(2)+5*DIF(1)+0.9*DIF(2)\nEND\n",
          "LINEAR/EIGENSOL\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("DIFF/1 follows from a condition"));
  ASSERT_EQ(r.eigenvalues(0).size(), 1u);
  EXPECT_NEAR(r.eigenvalues(0)[0].real(), -3.0 / 7 / (2 * std::numbers::pi), 1e-14);
  EXPECT_LT(r.result(0).at("modes").at(0).at("error_bound_hz").get<double>(), 1e-14);
}

TEST_F(DiffRates, held_in_dynamics_is_a_constant) {
  const std::string force = "-8*DIF(1)*" + z;
  for (const std::string& law : {"FUNCTION=2+" + v + "-DIF(1)", "IMPLICIT, FUNCTION=2+" + v + "-DIF(1)-DIF1(1)"}) {
    const std::string held = "DIFF/1, IC=0.7, DYNAMIC_HOLD, " + law + "\n";
    expect_spring(8 * 0.7, slider(force, held));
    // Statics finds z = 2; what the velocity changes of its equation afterwards does not count.
    expect_spring(8 * 2, slider(force, held, 0, 5), "SIMULATE/STATIC\nLINEAR/EIGENSOL\n");
    expect_spring(8 * 0.7, slider(force, "DIFF/1, STATIC_HOLD, IC=0.7, DYNAMIC_HOLD, " + law + "\n", 0, 5),
                  "SIMULATE/STATIC\nLINEAR/EIGENSOL\n");
  }
}

TEST_F(DiffRates, rate_of_what_is_held_is_zero) {
  const std::string held = "DIFF/1, IC=0.7, FUNCTION=2-DIF(1), DYNAMIC_HOLD\n";
  EXPECT_EQ(study_of(slider("0", held + "VARIABLE/1, FUNCTION=DIF1(1)+3\n")).initial_conditions().variable(1), 3);
  // DIFF/2 is algebraic, z₂ = 2 z₁ z with the rate 2 z₁ z′; DIFF/3 shares no rate with what has none.
  EXPECT_THAT(output_row(held + "DIFF/2, IMPLICIT, FUNCTION=DIF(2)-2*DIF(1)*" + z +
                         "\nVARIABLE/1, FUNCTION=DIF1(2)\nDIFF/3, IMPLICIT, FUNCTION=DIF1(3)+DIF1(1)+5*DIF(3)\n"),
              ElementsAre(DoubleNear(1.4, 1e-13), DoubleNear(0, 1e-13), DoubleNear(0, 1e-13)));
}

TEST_F(DiffRates, friction_in_a_joint_is_obsolete_and_changes_nothing) {
  std::string dataset = slider("-8*" + z, "");
  const std::string joint = "JOINT/1, TRANSLATIONAL, I=20, J=1";
  dataset.insert(dataset.find(joint) + joint.size(), ", FRICTION=ON, MU_STAT_TRANS=0.5, MU_DYN_TRANS=0.3, HEIGHT=1");
  expect_spring(8, dataset);
  const RunResult r = run(dataset, "LINEAR/EIGENSOL\n");
  EXPECT_THAT(r.err, HasSubstr("model.adm:8:"));
  EXPECT_THAT(r.err, HasSubstr("obsolete and ignored: FRICTION, MU_STAT_TRANS, MU_DYN_TRANS, HEIGHT"));
}

}  // namespace
}  // namespace dynalin::cases::diff_rates_test

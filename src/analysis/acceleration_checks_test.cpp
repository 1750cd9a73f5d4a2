// Accelerations of the start and what is looked at when they are found.
#include "analysis/acceleration_checks.h"

#include <gmock/gmock.h>

#include "analysis/initial.h"
#include "system/model_test_support.h"

namespace dynalin::analysis_test::acceleration_checks_test {
namespace {

using system_test::system_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string point = "POINT_MASS/2, MASS=2, CM=20\nMARKER/20, POINT_MASS=2\n";

Result<OperatingPoint> solved(const std::string& text, Findings& findings) {
  return initial_conditions(*system_of(text), findings);
}

// m a = m g + Gᵀλ with 3 x″ + 4 y″ = 10: a = g + s (3, 4), s = (10 − 3 g_x − 4 g_y)/25.
TEST(Accelerations, reactions_hold_what_constraints_ask) {
  Findings findings;
  const auto op = solved(
      "ACCGRAV/IGRAV=1, JGRAV=-2, KGRAV=5\n" + point + "GCON/1, FUNCTION=3*DX(20,1)+4*DY(20,1)-5*TIME**2\n", findings);
  ASSERT_TRUE(op) << op.error().message;
  const double s = (10 - 3 + 8) / 25.0;
  EXPECT_NEAR(op->acceleration[0], 1 + 3 * s, 1e-13);
  EXPECT_NEAR(op->acceleration[1], -2 + 4 * s, 1e-13);
  EXPECT_NEAR(op->acceleration[2], 5, 1e-13);
  EXPECT_NEAR(op->lambda[0], 2 * s, 1e-13);
}

// A spinning part: ω′ = J⁻¹ (−ω × J ω).
TEST(Accelerations, a_free_part_turns_by_eulers_equations) {
  Findings findings;
  const auto op = solved("PART/2, MASS=1, CM=20, IP=1,2,3, WX=0.5, WY=-1, WZ=2\nMARKER/20\n", findings);
  ASSERT_TRUE(op) << op.error().message;
  EXPECT_NEAR(op->acceleration[3], (2.0 - 3) / 1 * (-1 * 2), 1e-13);
  EXPECT_NEAR(op->acceleration[4], (3.0 - 1) / 2 * (2 * 0.5), 1e-13);
  EXPECT_NEAR(op->acceleration[5], (1.0 - 2) / 3 * (0.5 * -1), 1e-13);
}

TEST(AccelerationChecks, redundant_rows_that_differ_in_their_second_rate_contradict) {
  for (const auto& [second, contradicts] : {std::pair{"2*DX(20,1)-2*TIME**2", false},
                                            {"2*DX(20,1)-2.2*TIME**2", true},
                                            {"2*DX(20,1)-2.0000001*TIME**2", true},
                                            {"2*DX(20,1)-2*TIME**2+TIME**3", false}}) {
    Findings findings;
    const auto op = solved(point + "GCON/1, FUNCTION=DX(20,1)-TIME**2\nGCON/2, FUNCTION=" + second + "\n", findings);
    EXPECT_EQ(!op, contradicts) << second;
    if (!op) {
      EXPECT_THAT(op.error().message, HasSubstr("contradict each other on accelerations: "));
    }
  }
}

TEST(AccelerationChecks, redundant_rows_may_differ_by_what_ic_states_of_accelerations_and_no_more) {
  const std::string model =
      point + "GCON/1, FUNCTION=DX(20,1)-TIME**2\nGCON/2, FUNCTION=2*DX(20,1)-2.0000001*TIME**2\n";
  Findings findings;
  EXPECT_FALSE(solved(model, findings));
  EXPECT_TRUE(solved(model + "IC/AERROR=1E-6\n", findings));
  EXPECT_FALSE(solved(model + "IC/VERROR=1E-6\n", findings));
}

TEST(AccelerationChecks, iterations_are_as_many_as_ic_allows) {
  const std::string model = point + "VARIABLE/1, IC=1, FUNCTION=COS(VARVAL(1))\n";
  Findings findings;
  EXPECT_TRUE(solved(model, findings));
  EXPECT_TRUE(solved(model + "IC/AMAXIT=10\n", findings));
  const auto op = solved(model + "IC/AMAXIT=2\n", findings);
  ASSERT_FALSE(op);
  EXPECT_THAT(op.error().details, ::testing::Contains("IC allows 2 iterations (AMAXIT)"));
}

TEST(AccelerationChecks, a_contradiction_is_measured_in_the_terms_of_its_row) {
  const auto system = system_of(point + "GCON/1, FUNCTION=DX(20,1)\nGCON/2, FUNCTION=DX(20,1)\n");
  OperatingPoint op = system->drawn();
  AccelerationEquations equations(*system, op);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(equations.augmented().size());
  const std::int32_t row = equations.partition().redundant.at(0);
  const auto contradicted = [&](const Eigen::VectorXd& rounding) {
    equations.evaluate(op, {});
    return contradicted_accelerations(*system, equations, op, rounding);
  };
  EXPECT_THAT(contradicted(none), IsEmpty());
  op.acceleration[0] = 1e-3;  // what is left is as large as its only term
  EXPECT_THAT(contradicted(none), ElementsAre(row));
  op.acceleration[1] = 1e6;  // along other axes this would show as well
  EXPECT_THAT(contradicted(none), IsEmpty());
  op.acceleration[1] = 0;
  EXPECT_THAT(contradicted(Eigen::VectorXd::Constant(none.size(), 1e-3)), IsEmpty());
}

// w = w²/4 + c has w = 2 (1 − √(1 − c)); at c = 1 both roots meet, where dw/dc = 1/√(1 − c) has no value.
TEST(AccelerationChecks, digits_are_lost_near_a_double_root) {
  const auto text = [](const std::string& c) {
    return point + "VARIABLE/1, IC=0, FUNCTION=VARVAL(1)**2/4+" + c + "\n";
  };
  Findings findings;
  const auto good = solved(text("0.75"), findings);
  ASSERT_TRUE(good) << good.error().message;
  EXPECT_NEAR(good->algebraic[0], 1, 1e-13);
  EXPECT_THAT(findings.warnings.items(), IsEmpty());
  const auto near = solved(text("0.9999999999"), findings);
  ASSERT_TRUE(near) << near.error().message;
  ASSERT_EQ(findings.warnings.items().size(), 1u);
  EXPECT_EQ(findings.warnings.items()[0].code, "lost-digits");
  EXPECT_THAT(findings.warnings.items()[0].message, HasSubstr("VARIABLE/1"));
  const auto on = solved(text("1"), findings);
  ASSERT_FALSE(on);
  EXPECT_THAT(on.error().message, HasSubstr("the value of VARIABLE/1"));
}

// A stop at its touch, where the slope of its force is zero: VARIABLEs that it reads, however well they are known,
// leave a slope of roundings, of which none of the digits hold. No equation has a multiple root for it.
TEST(AccelerationChecks, functions_that_begin_at_a_touch_have_no_multiple_root) {
  const char* laws[] = {"1E4*MAX(0,#)**1.5",          "IMPACT(-#,0,0,1E4,1.5,10,0.1)",
                        "IMPACT(-#,0,0,1E4,2,0,0.1)", "BISTOP(#,0,-1,0,1E4,1.5,10,0.1)",
                        "STEP(#,0,0,1,1E4)",          "1E4*#**2",
                        "-1E4*STEP5(#,-1,0,0,1E4)"};
  for (const std::string law : laws) {
    for (const char* touch : {"0", "1E-15", "-1E-15", "3E-14", "1E-12"}) {
      // √(1² + 2²) − √5, of digits that other roundings take.
      std::string f = law;
      f.replace(f.find('#'), 1, std::string("(VARVAL(1)*SIN(VARVAL(2))-2+") + touch + ")");
      const std::string model = point + "MARKER/21, POINT_MASS=2, QP=1,2,0\n" +
                                "VARIABLE/1, FUNCTION=SQRT(DX(21,1)**2+DY(21,1)**2)\n"
                                "VARIABLE/2, FUNCTION=ATAN2(DY(21,1),DX(21,1))\n";
      const auto expect_nothing = [&](const std::string& reader) {
        Findings findings;
        const auto op = solved(model + reader, findings);
        EXPECT_TRUE(op) << (op ? "" : op.error().message) << " " << reader;
        for (const Diagnostic& d : findings.warnings.items()) EXPECT_NE(d.code, "lost-digits") << d.message << reader;
      };
      expect_nothing("SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=VARVAL(1)*" + f + "\n");
      expect_nothing("VARIABLE/3, FUNCTION=" + f + "\nDIFF/1, FUNCTION=VARVAL(3)*VARVAL(1)\n");
      expect_nothing("DIFF/1, IMPLICIT, FUNCTION=2*DIF1(1)-" + f + "\n");
    }
  }
}

// The force of a stop that gives way to its own force: the circle is closed, and regular all the same.
TEST(AccelerationChecks, a_touch_that_reads_its_own_force_has_no_multiple_root) {
  for (const char* touch : {"1E-16", "1E-13"}) {
    Findings findings;
    const auto op = solved(point + "VARIABLE/1, FUNCTION=" + touch +
                               "-1E-6*VARVAL(2)\nVARIABLE/2, FUNCTION=IMPACT(-VARVAL(1),0,0,1E4,1.5,0,0.1)\n",
                           findings);
    ASSERT_TRUE(op) << op.error().message;
    EXPECT_THAT(findings.warnings.items(), IsEmpty());
  }
}

// Of two values that make a double root together, and a stop that touches where they stand.
TEST(AccelerationChecks, a_double_root_beside_a_touch_is_told_by_its_own_name) {
  Findings findings;
  const auto op = solved(point +
                             "VARIABLE/1, FUNCTION=VARVAL(2)**2/4+0.9999999999\nVARIABLE/2, FUNCTION=VARVAL(1)\n"
                             "VARIABLE/3, FUNCTION=DX(20,1)+1E-14\n"
                             "VARIABLE/4, FUNCTION=1E4*MAX(0,VARVAL(3))**1.5\n",
                         findings);
  ASSERT_TRUE(op) << op.error().message;
  ASSERT_EQ(findings.warnings.items().size(), 1u);
  EXPECT_EQ(findings.warnings.items()[0].code, "lost-digits");
  EXPECT_THAT(findings.warnings.items()[0].message, HasSubstr("VARIABLE/1"));
}

// A damped wheel without mass at rest, on a hinge along none of the axes: its velocity is nothing but rounding, and so
// is what the rows of the hinge make of its square.
TEST(AccelerationChecks, accelerations_of_what_has_no_mass_lose_nothing) {
  for (const char* axes : {"1.7600,1.9317,-0.0898", "0.3,0.5,0.7", "2,1,0.5", "-1.1,0.4,2.2"}) {
    const std::string of = std::string(", REULER=") + axes + "\n";
    Findings findings;
    const auto op = solved("MARKER/2, PART=1" + of + "PART/2, MASS=3, CM=20, IP=0.2,0.3,0.25\nMARKER/20" + of +
                               "PART/6\nMARKER/60" + of +
                               "JOINT/1, REVOLUTE, I=20, J=2\nJOINT/2, REVOLUTE, I=60, J=2\n"
                               "SPRINGDAMPER/1, ROTATIONAL, I=60, J=20, KT=5, CT=0.3\n"
                               "SPRINGDAMPER/2, ROTATIONAL, I=60, J=2, KT=7\n",
                           findings);
    ASSERT_TRUE(op) << op.error().message;
    EXPECT_THAT(findings.warnings.items(), IsEmpty());
  }
}

// Where the force of a damper has no slope, (v − 1)² = 0, its velocity is known to half the digits, mass or none.
TEST(AccelerationChecks, velocities_of_what_has_no_mass_lose_digits_near_a_double_root) {
  Findings findings;
  const auto op = solved(
      "PART/2\nMARKER/20\nJOINT/2, TRANSLATIONAL, I=20, J=1\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=1-2*VZ(20,1,1)+VZ(20,1,1)**2\n",
      findings);
  ASSERT_TRUE(op) << op.error().message;
  ASSERT_EQ(findings.warnings.items().size(), 1u);
  EXPECT_EQ(findings.warnings.items()[0].code, "lost-digits");
  EXPECT_THAT(findings.warnings.items()[0].message, HasSubstr("the balance of freedoms without mass"));
}

}  // namespace
}  // namespace dynalin::analysis_test::acceleration_checks_test

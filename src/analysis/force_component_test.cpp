// Functions that read a component of a force across it: nothing but rounding, which follows the last places of the
// force and has no part in the derivative of the function.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "analysis/initial.h"
#include "analysis/statics_test_support.h"

namespace dynalin::analysis_test::force_component_test {
namespace {

// Angles with which the rounding of a component never came to rest beside what an equation of its own settles.
constexpr std::array turned = {"0.4,2.42,2.29", "2.87,2.67,0.17", "0.71,1.66,1.11", "0.68,2.71,0.38"};

std::string pushed(const std::string& angles, const std::string& component) {
  return "MARKER/8, PART=1, REULER=" + angles +
         "\nPART/2, MASS=1, CM=20, IP=1,2,3\nMARKER/20\nBUSHING/1, I=20, J=8, K=10,20,30, KT=2,3,4\n"
         "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=8, FUNCTION=VARVAL(1)\n"
         "VARIABLE/1, FUNCTION=0.1+0.4*TANH(VARVAL(1))-0.16*SFORCE(1,0,1,0)\n"
         "VARIABLE/2, FUNCTION=1.76*" +
         component + "\n";
}

class ForceComponent : public ::testing::TestWithParam<const char*> {};

TEST_P(ForceComponent, across_a_force_is_found_by_initial_conditions) {
  for (const std::string angles : turned) {
    SCOPED_TRACE(angles);
    Findings findings;
    const auto op = initial_conditions(*system_of(pushed(angles, GetParam())), findings);
    ASSERT_TRUE(op) << op.error().message;
    EXPECT_NEAR(op->algebraic.back(), 0, 1e-15);
  }
}

TEST_P(ForceComponent, across_a_force_is_found_by_statics) {
  for (const std::string angles : turned) {
    SCOPED_TRACE(angles);
    const auto system = system_of(pushed(angles, GetParam()));
    StaticsReport report;
    Findings findings;
    const auto op = find_equilibrium(*system, system->drawn(), {}, report, findings);
    ASSERT_TRUE(op) << op.error().message;
    EXPECT_NEAR(op->algebraic.back(), 0, 1e-15);
  }
}
INSTANTIATE_TEST_SUITE_P(of_an_action, ForceComponent, ::testing::Values("SFORCE(1,0,2,8)", "SFORCE(1,0,3,8)"));

// ε times the force is what such a component is known to, and that of its moment goes by the lever.
TEST(ForceComponent, is_as_large_as_what_it_is_added_up_from) {
  const auto system = system_of(
      "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20\nMARKER/21, QP=0,3,0\nMARKER/9, PART=1\n"
      "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=21, J=9, FUNCTION=7\n"
      "SFORCE/2, TRANSLATIONAL, I=21, J=9, FUNCTION=5\n"
      "VARIABLE/1, FUNCTION=-2*SFORCE(1,0,2,9)\nVARIABLE/2, FUNCTION=2*SFORCE(2,1,8,9)\n");
  OperatingPoint op = system->drawn();
  op.algebraic = {7, 5, 0, 0};
  Equations eq;
  eq.resize(system->layout());
  ConstraintRows rows;
  rows.resize(system->layout());
  const Motion motion = system->motion(op);
  system->constraints(motion, rows);
  system->equations(motion, rows, eq, {PartialBy::algebraic});
  EXPECT_DOUBLE_EQ(eq.magnitude()[static_cast<std::size_t>(eq.algebraic_row(2))], 2 * 7);
  EXPECT_DOUBLE_EQ(eq.magnitude()[static_cast<std::size_t>(eq.algebraic_row(3))], 2 * 3 * 5);
}

}  // namespace
}  // namespace dynalin::analysis_test::force_component_test

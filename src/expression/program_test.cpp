// Evaluation and differentiation of whole expressions, and the search for faults.
#include "expression/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "expression/expression_test_support.h"

namespace dynalin::expression_test::program_test {
namespace {

using Taylor = TimeTaylor<double>;
using ::testing::ElementsAre;

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(ExpressionProgram, default_and_constant_expressions_have_no_atoms) {
  EXPECT_TRUE(Expression().is_constant());
  EXPECT_EQ(evaluate<double>(Expression(), {}).value, 0);
  EXPECT_EQ(evaluate<Taylor>(Expression::constant(2.5), {}).value.value, 2.5);
}

TEST(ExpressionProgram, a_product_of_measures_has_the_partials_of_the_product_rule) {
  const Result<double> r = evaluate("DX(1,2)*SIN(TIME)/DX(1,2)**2 - 3*TIME", {2.0, 0.5});
  EXPECT_DOUBLE_EQ(r.value, std::sin(0.5) / 2 - 1.5);
  EXPECT_DOUBLE_EQ(r.partial[0], -std::sin(0.5) / 4);
  EXPECT_DOUBLE_EQ(r.partial[1], std::cos(0.5) / 2 - 3);
}

TEST(ExpressionProgram, only_the_selected_branch_of_an_if_is_evaluated) {
  const std::string text = "IF(VARVAL(1): VARVAL(2)**2, 7*VARVAL(3), SQRT(VARVAL(4)))";
  const double x = -1;  // SQRT(-1) would be NaN
  EXPECT_THAT(evaluate(text, {-1, 3, 5, x}).partial, ElementsAre(0, 6, 0, 0));
  EXPECT_EQ(evaluate(text, {-1, 3, 5, x}).value, 9);
  EXPECT_THAT(evaluate(text, {0, 3, 5, x}).partial, ElementsAre(0, 0, 7, 0));
  EXPECT_TRUE(std::isnan(evaluate(text, {1, 3, 5, x}).value));
  EXPECT_THAT(evaluate(text, {1, 3, 5, 4}).partial, ElementsAre(0, 0, 0, 0.25));
  EXPECT_FALSE(fault(text, {0, 3, 5, x}));
}

TEST(ExpressionProgram, old_values_of_other_branches_do_not_leak) {
  const ParsedText parsed = parse("1+IF(VARVAL(1): SQRT(VARVAL(2)), 0, VARVAL(3)*IF(VARVAL(2): 1, 2, 3))");
  ExpressionWorkspace<double> workspace;
  std::vector<double> partial(3);
  const std::vector<double> negative{-1, -1, 4}, positive{1, 4, 5};
  parsed.expression.evaluate<double>(negative, partial, workspace);
  EXPECT_EQ(parsed.expression.evaluate<double>(positive, partial, workspace), 16);
  EXPECT_THAT(partial, ElementsAre(0, 0, 3));
}

TEST(ExpressionProgram, nested_ifs_select_by_sign) {
  const std::string text = "IF(TIME-1: 10, 20, IF(TIME-2: 30, 40, 50)) * VARVAL(1)";
  const double times[] = {0, 1, 1.5, 2, 3}, values[] = {10, 20, 30, 40, 50};
  for (int k = 0; k < 5; ++k) {
    const Result<double> r = evaluate(text, {times[k], 2});
    EXPECT_EQ(r.value, 2 * values[k]);
    EXPECT_THAT(r.partial, ElementsAre(0, values[k]));
  }
}

TEST(ExpressionProgram, taylor_carries_rates_through_operators) {
  // x = 2 + 3 t + 4 t²/2, y = 5 − t: the derivatives of x y / (x − y) ** 2 in closed form.
  const Taylor x(2, 3, 4), y(5, -1, 0);
  const Result<Taylor> r =
      evaluate(parse("VARVAL(1)*VARVAL(2)/(VARVAL(1)-VARVAL(2))**2").expression, std::vector<Taylor>{x, y});
  const Taylor d = x - y, expected = x * y / (d * d);
  EXPECT_NEAR(r.value.value, expected.value, 1e-15);
  EXPECT_NEAR(r.value.rate, expected.rate, 1e-14);
  EXPECT_NEAR(r.value.acceleration, expected.acceleration, 1e-13);
  const Taylor by_x = y / (d * d) - 2.0 * (x * y / (d * d * d));
  EXPECT_NEAR(r.partial[0].value, by_x.value, 1e-14);
  EXPECT_NEAR(r.partial[0].rate, by_x.rate, 1e-13);
  EXPECT_NEAR(r.partial[0].acceleration, by_x.acceleration, 1e-12);
}

TEST(ExpressionProgram, a_rate_that_is_not_known_stays_unknown) {
  // A velocity has no second derivative in position-level data.
  const Taylor velocity(2, 3, std::numeric_limits<double>::quiet_NaN());
  const Result<Taylor> r = evaluate(parse("SIN(VX(1,2))").expression, std::vector{velocity});
  EXPECT_DOUBLE_EQ(r.value.rate, 3 * std::cos(2.0));
  EXPECT_TRUE(std::isnan(r.value.acceleration));
  EXPECT_DOUBLE_EQ(r.partial[0].rate, -3 * std::sin(2.0));
  EXPECT_TRUE(std::isnan(r.partial[0].acceleration));
}

TEST(ExpressionProgram, infinite_slopes_do_not_matter_where_nothing_depends_on_them) {
  const struct {
    const char* text;
    std::vector<double> x;
    double partial;
  } table[] = {
      {"0*SQRT(VARVAL(1))", {0}, 0},
      {"SQRT(VARVAL(1))*0 + VARVAL(1)", {0}, 1},
      {"SQRT(0*VARVAL(1)) + VARVAL(1)", {0}, 1},
      {"SQRT(MAX(0,VARVAL(1)))", {-2}, 0},
      {"SQRT(STEP(VARVAL(1),1,0,2,1))", {0.5}, 0},
      {"SQRT(VARVAL(1)**0-1)", {3}, 0},
      {"IF(VARVAL(1): SQRT(VARVAL(1)), 1, SQRT(VARVAL(1)))", {0}, 0},
      {"STEP(VARVAL(1),1,0,2,SQRT(VARVAL(1)))", {0}, 0},
  };
  for (const auto& row : table) {
    EXPECT_THAT(evaluate(row.text, row.x).partial, ElementsAre(row.partial)) << row.text;
    EXPECT_FALSE(fault(row.text, row.x)) << row.text;
  }
  EXPECT_TRUE(std::isinf(evaluate("SQRT(VARVAL(1))", {0}).partial[0]));
  EXPECT_TRUE(std::isnan(evaluate("SQRT(VARVAL(1)**2)", {0}).partial[0]));
}

TEST(ExpressionProgram, an_infinite_slope_at_rest_gives_no_rate) {
  const Result<Taylor> r = evaluate(parse("SQRT(VARVAL(1))+VARVAL(1)**1.5").expression, std::vector{Taylor(0.0)});
  EXPECT_EQ(r.value.rate, 0);
  EXPECT_EQ(r.value.acceleration, 0);
  EXPECT_EQ(r.partial[0].value, infinity);
}

struct FaultRow {
  const char* text;
  std::vector<double> x;
  const char* function;
  const char* place;
  const char* reason;
};

TEST(ExpressionProgram, the_culprit_of_a_value_that_is_not_finite_is_named) {
  const FaultRow table[] = {
      {"1+2*SQRT(VARVAL(1)-1)", {-2}, "SQRT", "SQRT(VARVAL(1)-1)", "SQRT of -3"},
      {"SIN(1/VARVAL(1))", {0}, "/", "1/VARVAL(1)", "division by 0"},
      {"LOG(VARVAL(1))", {0}, "LOG", "LOG(VARVAL(1))", "LOG of 0"},
      {"LOG10(VARVAL(1))", {-1}, "LOG10", "LOG10(VARVAL(1))", "LOG10 of -1"},
      {"ASIN(VARVAL(1))", {-1.0000000001}, "ASIN", "ASIN(VARVAL(1))", "ASIN of -1.0000000001, which is outside −1 … 1"},
      {"2*ACOS(VARVAL(1))", {2}, "ACOS", "ACOS(VARVAL(1))", "ACOS of 2, which is outside −1 … 1"},
      {"(VARVAL(1)+1)**-2", {-1}, "**", "(VARVAL(1)+1)**-2", "0 to the power -2"},
      {"VARVAL(1)**.5", {-2}, "**", "VARVAL(1)**.5", "-2 to the power 0.5"},
      {"VARVAL(1)**VARVAL(2)", {-2, 0.5}, "**", "VARVAL(1)**VARVAL(2)", "-2 to the power 0.5"},
      {"MOD(VARVAL(1),VARVAL(2))", {3, 0}, "MOD", "MOD(VARVAL(1),VARVAL(2))", "MOD with the divisor 0"},
      {"EXP(VARVAL(1))", {1000}, "EXP", "EXP(VARVAL(1))", "the result of EXP is too large at 1000"},
      {"IF(TIME: 1, 2, 1/0)", {1}, "/", "1/0", "division by 0"},
      {"IF(SQRT(TIME): 1, 2, 3)", {-1}, "SQRT", "SQRT(TIME)", "SQRT of -1"},
      {"STEP(TIME,VARVAL(1),0,VARVAL(2),1)",
       {0, 3, 3},
       "STEP",
       "STEP(TIME,VARVAL(1),0,VARVAL(2),1)",
       "STEP with x0 = x1 = 3"},
      {"IMPACT(TIME,0,1,1,VARVAL(1),1,1)",
       {0, -1},
       "IMPACT",
       "IMPACT(TIME,0,1,1,VARVAL(1),1,1)",
       "IMPACT with e = -1 where it needs e > 0"},
      {"1+DX(1,2)", {infinity}, "DX", "DX(1,2)", "DX(1,2) has no finite value"},
  };
  for (const FaultRow& row : table) {
    const ParsedText parsed = parse(row.text);
    const auto found = parsed.expression.find_undefined(std::span<const double>(row.x), UndefinedSearch::value);
    ASSERT_TRUE(found) << row.text;
    EXPECT_EQ(found->function, row.function);
    EXPECT_EQ(found->at.text(), row.place);
    EXPECT_EQ(found->reason, row.reason);
  }
  EXPECT_FALSE(fault("SQRT(VARVAL(1))", {0}, UndefinedSearch::value));
}

TEST(ExpressionProgram, the_culprit_of_a_derivative_that_is_not_finite_is_named) {
  const FaultRow table[] = {
      {"1+SQRT(VARVAL(1))", {0}, "SQRT", "SQRT(VARVAL(1))", "the derivative of SQRT is infinite at 0"},
      {"3*SQRT(VARVAL(1)**2)", {0}, "SQRT", "SQRT(VARVAL(1)**2)", "the derivative of SQRT is infinite at 0"},
      {"ATAN2(VARVAL(1),VARVAL(2))",
       {0, 0},
       "ATAN2",
       "ATAN2(VARVAL(1),VARVAL(2))",
       "the derivative of ATAN2 is not defined at (0, 0)"},
      {"VARVAL(1)**.5", {0}, "**", "VARVAL(1)**.5", "the derivative of ** is infinite at (0, 0.5)"},
      {"ASIN(VARVAL(1))", {1}, "ASIN", "ASIN(VARVAL(1))", "the derivative of ASIN is infinite at 1"},
  };
  for (const FaultRow& row : table) {
    const ParsedText parsed = parse(row.text);
    const auto found =
        parsed.expression.find_undefined(std::span<const double>(row.x), UndefinedSearch::value_and_partials);
    ASSERT_TRUE(found) << row.text;
    EXPECT_EQ(found->function, row.function);
    EXPECT_EQ(found->at.text(), row.place);
    EXPECT_EQ(found->reason, row.reason);
  }
}

TEST(ExpressionProgram, faults_in_time_derivatives_are_found_on_taylor) {
  const ParsedText parsed = parse("VARVAL(1)**1.5");
  const std::vector<Taylor> moving{Taylor(0, 1, 0)}, resting{Taylor(0.0)};
  const auto found = parsed.expression.find_undefined(std::span<const Taylor>(moving), UndefinedSearch::value);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->reason, "a time derivative of ** is infinite at (0, 1.5)");
  EXPECT_FALSE(parsed.expression.find_undefined(std::span<const Taylor>(resting), UndefinedSearch::value_and_partials));
}

}  // namespace
}  // namespace dynalin::expression_test::program_test

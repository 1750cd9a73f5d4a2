// Every mathematical and general function: values computed elsewhere to 17 digits, derivatives
// against central differences, rates against differences in time, and what happens exactly at
// kinks.
#include "expression/functions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "expression/expression_test_support.h"

namespace dynalin::expression_test::functions_test {
namespace {

using Taylor = TimeTaylor<double>;
using ::testing::ElementsAre;

struct Row {
  std::string name;
  std::vector<double> argument;
  double value;
};

// The values come from the definitions (SWEEP by quadrature of its frequency) in 40-digit
// arithmetic.
const std::vector<Row>& rows() {
  static const std::vector<Row> table = {
      // clang-format off
      {"ABS", {-2.5}, 2.5},
      {"ABS", {1.25}, 1.25},
      {"ACOS", {0.3}, 1.2661036727794991},
      {"ACOS", {-0.7}, 2.3461938234056497},
      {"ASIN", {0.3}, 0.30469265401539751},
      {"ASIN", {-0.7}, -0.77539749661075306},
      {"ATAN", {1.7}, 1.039072259536091},
      {"ATAN", {-0.4}, -0.38050637711236489},
      {"ATAN2", {1, 2}, 0.46364760900080612},
      {"ATAN2", {-1, -2}, -2.6779450445889871},
      {"ATAN2", {3, -0.5}, 1.7359450042095235},
      {"COS", {0.8}, 0.69670670934716542},
      {"COS", {-4}, -0.65364362086361191},
      {"SIN", {0.8}, 0.71735609089952276},
      {"SIN", {-4}, 0.75680249530792825},
      {"TAN", {0.8}, 1.029638557050364},
      {"TAN", {2.5}, -0.74702229723866028},
      {"COSH", {1.3}, 1.9709142303266284},
      {"SINH", {1.3}, 1.6983824372926158},
      {"SINH", {-0.2}, -0.20133600254109399},
      {"TANH", {0.6}, 0.53704956699803529},
      {"EXP", {-1.5}, 0.22313016014842983},
      {"EXP", {2.25}, 9.4877358363585257},
      {"SQRT", {7}, 2.6457513110645906},
      {"SQRT", {0.25}, 0.5},
      {"LOG", {7}, 1.9459101490553133},
      {"LOG", {0.2}, -1.6094379124341004},
      {"LOG10", {7}, 0.84509804001425683},
      {"LOG10", {0.2}, -0.69897000433601880},
      {"AINT", {-2.7}, -2.0},
      {"AINT", {2.7}, 2.0},
      {"ANINT", {-2.7}, -3.0},
      {"ANINT", {2.3}, 2.0},
      {"DIM", {3, 1.25}, 1.75},
      {"DIM", {1, 3}, 0.0},
      {"MAX", {2, 5}, 5.0},
      {"MAX", {-1, -2, -3}, -1.0},
      {"MIN", {2, 5}, 2.0},
      {"MIN", {4, 3, 9, 8}, 3.0},
      {"MOD", {7.5, 2}, 1.5},
      {"MOD", {-7.5, 2}, -1.5},
      {"MOD", {7.5, -2}, 1.5},
      {"SIGN", {3, -0.1}, -3.0},
      {"SIGN", {-3, 4}, 3.0},
      {"SIGN", {-3, -4}, -3.0},
      {"STEP", {1.3, 1, 2, 3, -5}, 1.57475},
      {"STEP", {2.6, 1, 2, 3, -5}, -4.272},
      {"STEP", {0.5, 1, 2, 3, -5}, 2.0},
      {"STEP", {3.5, 1, 2, 3, -5}, -5.0},
      {"STEP", {1.3, 3, 2, 1, -5}, -4.57475},
      {"STEP", {4, 3, 2, 1, -5}, 2.0},
      {"STEP", {0, 3, 2, 1, -5}, -5.0},
      {"STEP5", {1.3, 1, 2, 3, -5}, 1.813716875},
      {"STEP5", {2.6, 1, 2, 3, -5}, -4.59456},
      {"STEP5", {0.5, 1, 2, 3, -5}, 2.0},
      {"STEP5", {2.2, 3, 2, 1, -5}, -0.22208},
      {"HAVSIN", {1.3, 1, 2, 3, -5}, 1.6185228346592875},
      {"HAVSIN", {2.6, 1, 2, 3, -5}, -4.331559480312316},
      {"HAVSIN", {3.5, 1, 2, 3, -5}, -5.0},
      {"IMPACT", {0.7, -0.4, 1, 1000, 1.5, 20, 0.5}, 169.50076725154983},
      {"IMPACT", {0.2, 0.3, 1, 1000, 2.2, 20, 0.5}, 606.06559986562367},
      {"IMPACT", {0.999, 5, 1, 10, 1.5, 2000, 0.5}, 0.0},
      {"IMPACT", {1.2, -3, 1, 1000, 1.5, 20, 0.5}, 0.0},
      {"BISTOP", {0.7, -0.4, 1, 2, 1000, 1.5, 20, 0.5}, 169.50076725154983},
      {"BISTOP", {2.3, 0.4, 1, 2, 1000, 1.5, 20, 0.5}, -169.50076725154983},
      {"BISTOP", {2.9, -0.4, 1, 2, 1000, 1.5, 20, 0.5}, -845.81496824546242},
      {"BISTOP", {1.5, 1, 1, 2, 1000, 1.5, 20, 0.5}, 0.0},
      {"BISTOP", {2.001, -9, 1, 2, 10, 1.5, 2000, 0.5}, 0.0},
      {"POLY", {1.7, 0.5, 2, -3, 0.25, 1.5}, 1.352},
      {"POLY", {1.7, 0.5, 2}, 2.0},
      {"CHEBY", {0.9, 0.3, 1, 2, 3, 4, 5, 6}, -7.05504},
      {"CHEBY", {2.5, 0.3, 1, -2, 3}, 22.64},
      {"CHEBY", {2.5, 0.3, 7}, 7.0},
      {"FORCOS", {0.9, 0.3, 2.5, 1, 2, 3, -4}, -0.98531988874281173},
      {"FORSIN", {0.9, 0.3, 2.5, 1, 2, 3, -4}, 7.3284704680480987},
      {"FORSIN", {0.9, 0.3, 2.5, 1}, 1.0},
      {"SHF", {0.9, 0.3, 2, 2.5, 0.4, -1}, 0.78241472012287068},
      {"SWEEP", {0.5, 3, 1, 0.2, 4, 0.9, 1.5}, 0.0},
      {"SWEEP", {1.7, 3, 1, 0.2, 4, 0.9, 1.5}, 0.79058211430011075},
      {"SWEEP", {3.3, 3, 1, 0.2, 4, 0.9, 1.5}, 2.9564017583141226},
      {"SWEEP", {5.2, 3, 1, 0.2, 4, 0.9, 1.5}, -1.2773378746952179},
      // clang-format on
  };
  return table;
}

std::string call_text(const std::string& name, std::size_t count) {
  std::string text = name;
  for (std::size_t k = 0; k < count; ++k) {
    text += (k == 0 ? "(VARVAL(" : ",VARVAL(") + std::to_string(k + 1) + ")";
  }
  return text + ")";
}

std::string shown(const Row& row) { return row.name + ::testing::PrintToString(row.argument); }

double tolerance(double x, double relative) { return relative * std::max(1.0, std::fabs(x)); }

// Fourth-order central differences of f(−2h) … f(2h); their error is far below the tolerances used.
template <class F>
double first_difference(F f, double h) {
  return (f(-2 * h) - 8 * f(-h) + 8 * f(h) - f(2 * h)) / (12 * h);
}
template <class F>
double second_difference(F f, double h) {
  return (-f(-2 * h) + 16 * f(-h) - 30 * f(0) + 16 * f(h) - f(2 * h)) / (12 * h * h);
}

TEST(ExpressionFunctions, values_agree_with_the_definitions) {
  for (const Row& row : rows()) {
    const std::string text = call_text(row.name, row.argument.size());
    EXPECT_NEAR(value(text, row.argument), row.value, tolerance(row.value, 4e-15)) << shown(row);
  }
}

TEST(ExpressionFunctions, every_function_is_in_the_table_of_values) {
  std::set<std::string_view> tested;
  for (const Row& row : rows()) tested.insert(row.name);
  for (const auto& family : {elementary_functions(), contact_functions(), series_functions()}) {
    for (const Function& f : family) EXPECT_TRUE(tested.contains(f.name)) << f.name;
  }
}

TEST(ExpressionFunctions, partials_agree_with_central_differences) {
  for (const Row& row : rows()) {
    const Expression e = parse(call_text(row.name, row.argument.size())).expression;
    const Result<double> exact = evaluate(e, row.argument);
    for (std::size_t k = 0; k < row.argument.size(); ++k) {
      const double numeric = first_difference(
          [&](double h) {
            std::vector<double> moved = row.argument;
            moved[k] += h;
            return evaluate(e, moved).value;
          },
          1e-4);
      EXPECT_NEAR(exact.partial[k], numeric, tolerance(numeric, 1e-8)) << shown(row) << " by " << k;
    }
  }
}

TEST(ExpressionFunctions, taylor_values_and_partials_agree_with_differences_in_time) {
  for (const Row& row : rows()) {
    const std::size_t n = row.argument.size();
    const Expression e = parse(call_text(row.name, n)).expression;
    std::vector<Taylor> course;
    for (std::size_t k = 0; k < n; ++k) {
      const double phase = static_cast<double>(k);
      course.emplace_back(row.argument[k], 0.17 * std::cos(phase), 0.3 * std::sin(1 + phase));
    }
    const auto at_time = [&](double t) {
      std::vector<double> x;
      for (const Taylor& c : course) x.push_back(c.value + t * c.rate + 0.5 * t * t * c.acceleration);
      return evaluate(e, x);
    };
    const Result<Taylor> exact = evaluate(e, course);
    const auto compare = [&](const Taylor& x, auto component, const std::string& what) {
      const auto f = [&](double t) { return component(at_time(t)); };
      const double rate = first_difference(f, 2e-3), acceleration = second_difference(f, 2e-3);
      EXPECT_NEAR(x.value, f(0), tolerance(f(0), 1e-13)) << what;
      EXPECT_NEAR(x.rate, rate, tolerance(rate, 2e-7)) << what;
      EXPECT_NEAR(x.acceleration, acceleration, tolerance(acceleration, 1e-5)) << what;
    };
    compare(
        exact.value, [](const Result<double>& r) { return r.value; }, shown(row));
    for (std::size_t k = 0; k < n; ++k) {
      compare(
          exact.partial[k], [k](const Result<double>& r) { return r.partial[k]; },
          shown(row) + " by " + std::to_string(k));
    }
  }
}

TEST(ExpressionFunctions, long_argument_lists_are_differentiated_in_passes) {
  std::string text = "FORCOS(VARVAL(1),VARVAL(2),VARVAL(3)";
  std::vector<double> x{0.7, 0.2, 0.3};
  for (int j = 0; j <= 30; ++j) {
    text += ",VARVAL(" + std::to_string(j + 4) + ")";
    x.push_back(1.0 / (j + 1));
  }
  const Result<double> r = evaluate(text + ")", x);
  for (std::size_t j = 0; j <= 30; ++j) {
    EXPECT_NEAR(r.partial[j + 3], std::cos(static_cast<double>(j) * 0.15), 1e-14);
  }
  EXPECT_NEAR(r.partial[0], -r.partial[1], 1e-14);
}

struct Kink {
  const char* text;
  std::vector<double> x;
  double value;
  std::vector<double> partial;
};

TEST(ExpressionFunctions, kinks_take_the_documented_side) {
  const std::string step = call_text("STEP", 5), step5 = call_text("STEP5", 5), havsin = call_text("HAVSIN", 5);
  const Kink table[] = {
      {"ABS(VARVAL(1))", {0}, 0, {0}},
      {"DIM(VARVAL(1),VARVAL(2))", {3, 3}, 0, {0, 0}},
      {"MAX(VARVAL(1),VARVAL(2))", {3, 3}, 3, {1, 0}},
      {"MIN(VARVAL(1),VARVAL(2),VARVAL(3))", {3, 3, 3}, 3, {1, 0, 0}},
      {"SIGN(VARVAL(1),VARVAL(2))", {-3, 0}, 3, {-1, 0}},
      {"SIGN(VARVAL(1),VARVAL(2))", {0, -2}, 0, {0, 0}},
      {"AINT(VARVAL(1))", {2}, 2, {0}},
      {"ANINT(VARVAL(1))", {2.5}, 3, {0}},
      {"ANINT(VARVAL(1))", {-2.5}, -3, {0}},
      {"MOD(VARVAL(1),VARVAL(2))", {6, 2}, 0, {1, -3}},
      {"MOD(VARVAL(1),VARVAL(2))", {0.3, 0.1}, std::fmod(0.3, 0.1), {1, -2}},
      {step.c_str(), {1, 1, 5, 2, 7}, 5, {0, 0, 1, 0, 0}},
      {step.c_str(), {2, 1, 5, 2, 7}, 7, {0, 0, 0, 0, 1}},
      {step.c_str(), {2, 2, 5, 1, 7}, 5, {0, 0, 1, 0, 0}},
      {step5.c_str(), {1, 1, 5, 2, 7}, 5, {0, 0, 1, 0, 0}},
      {havsin.c_str(), {2, 1, 5, 2, 7}, 7, {0, 0, 0, 0, 1}},
      {"IMPACT(VARVAL(1),VARVAL(2),0,100,0.5,1,0.1)", {0, -1}, 0, {0, 0}},
      {"BISTOP(VARVAL(1),VARVAL(2),0,1,100,1,1,0.1)", {0, -1}, 0, {0, 0}},
      {"BISTOP(VARVAL(1),VARVAL(2),0,1,100,1,1,0.1)", {1, 1}, 0, {0, 0}},
      {"ATAN2(-VARVAL(1),VARVAL(2))", {0, -1}, std::numbers::pi, {1, 0}},
      {"VARVAL(1)**1.5", {0}, 0, {0}},
      {"VARVAL(1)**1", {0}, 0, {1}},
      {"VARVAL(1)**0", {0}, 1, {0}},
      {"VARVAL(1)**VARVAL(2)", {0, 2}, 0, {0, 0}},
      {"VARVAL(1)**2", {-3}, 9, {-6}},
      {"VARVAL(1)**3", {-2}, -8, {12}},
      {"2**VARVAL(1)", {3}, 8, {8 * std::numbers::ln2}},
  };
  for (const Kink& row : table) {
    const Result<double> r = evaluate(row.text, row.x);
    EXPECT_DOUBLE_EQ(r.value, row.value) << row.text;
    EXPECT_THAT(r.partial, ::testing::Pointwise(::testing::DoubleEq(), row.partial)) << row.text;
  }
}

TEST(ExpressionFunctions, power_with_varying_exponent_has_both_partials) {
  const Result<double> r = evaluate("VARVAL(1)**VARVAL(2)", {2.5, 1.7});
  EXPECT_NEAR(r.partial[0], 1.7 * std::pow(2.5, 0.7), 1e-14);
  EXPECT_NEAR(r.partial[1], std::pow(2.5, 1.7) * std::log(2.5), 1e-14);
  // A negative base has a derivative for itself, but none for the exponent.
  const Result<double> negative = evaluate("VARVAL(1)**VARVAL(2)", {-2, 3});
  EXPECT_DOUBLE_EQ(negative.value, -8);
  EXPECT_DOUBLE_EQ(negative.partial[0], 12);
  EXPECT_TRUE(std::isnan(negative.partial[1]));
}

TEST(ExpressionFunctions, undefined_arguments_give_no_number) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* text :
       {"MAX(VARVAL(1),1)", "MAX(1,VARVAL(1))", "MIN(1,VARVAL(1),-1)", "DIM(1,VARVAL(1))", "SIGN(1,VARVAL(1))",
        "ABS(VARVAL(1))", "STEP(VARVAL(1),0,0,1,1)", "IMPACT(VARVAL(1),0,0,1,1,1,1)", "BISTOP(VARVAL(1),0,0,1,1,1,1,1)",
        "IF(VARVAL(1):1,2,3)", "SWEEP(VARVAL(1),1,0,1,2,3,1)"}) {
    EXPECT_TRUE(std::isnan(value(text, {nan}))) << text;
  }
  EXPECT_TRUE(std::isnan(value(call_text("STEP", 5), {0, 1, 2, 1, 3})));
}

}  // namespace
}  // namespace dynalin::expression_test::functions_test

// Functions of formulas on all their scalars: values as those of double, slopes and second derivatives by differences
// of them.
#include <gtest/gtest.h>

#include <cmath>
#include <dynalin/user_routine.hpp>

namespace dynalin::cases::formula_functions_test {
namespace {

using user::Course;
using user::Partials;

// x(t) = x + v t + a t²/2.
constexpr double v = 0.7, a = -0.4;

template <class Function>
void expect_derivatives(const char* name, double x, const Function& f) {
  const double value = f(x);
  constexpr double h = 1e-4;
  const double slope = (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h);
  const double second = (16 * (f(x + h) + f(x - h)) - (f(x + 2 * h) + f(x - 2 * h)) - 30 * value) / (12 * h * h);
  const double size = 1 + std::abs(value) + std::abs(slope) + std::abs(second);
  Partials p(x);
  p.d[2] = 1;
  const Partials by_input = f(p);
  EXPECT_NEAR(by_input.x, value, 1e-14 * size) << name;
  EXPECT_NEAR(by_input.d[2], slope, 1e-9 * size) << name;
  EXPECT_EQ(by_input.d[0], 0) << name;
  Course c(p, Partials(v), Partials(a));
  const Course along = f(c);
  EXPECT_NEAR(along.x.x, value, 1e-14 * size) << name;
  EXPECT_NEAR(along.x1.x, slope * v, 1e-9 * size) << name;
  EXPECT_NEAR(along.x2.x, second * v * v + slope * a, 1e-6 * size) << name;
  EXPECT_NEAR(along.x1.d[2], second * v, 1e-6 * size) << name;
}

TEST(FormulaFunctions, have_their_values_and_derivatives_on_every_scalar) {
  using namespace dynalin::user;  // NOLINT
  const auto expect = [](const char* name, const auto& f) {
    for (const double x : {0.31, 0.83}) expect_derivatives(name, x, f);
  };
  const auto expect_on_both_sides = [](const char* name, const auto& f) {
    for (const double x : {-0.92, -0.27, 0.31, 0.83}) expect_derivatives(name, x, f);
  };
  expect_on_both_sides("abs", [](auto x) { return abs(x) * x; });
  expect_on_both_sides("fabs", [](auto x) { return fabs(x); });
  expect("sqrt", [](auto x) { return sqrt(x); });
  expect_on_both_sides("cbrt", [](auto x) { return cbrt(x); });
  expect("pow", [](auto x) { return pow(x, 2.5) + pow(2.0, x) + pow(x, x); });
  expect_on_both_sides("hypot", [](auto x) { return hypot(x, 0.5) + hypot(2.0, x) + hypot(x, x * x); });
  expect_on_both_sides("sin", [](auto x) { return sin(x) + cos(2.0 * x) + tan(x); });
  expect_on_both_sides("asin", [](auto x) { return asin(x) - 2.0 * acos(x) + atan(x); });
  expect_on_both_sides("atan2", [](auto x) { return atan2(x, -0.5) + atan2(-2.0, x) + atan2(x * x, x); });
  expect_on_both_sides("sinh", [](auto x) { return sinh(x) + cosh(x) + tanh(x); });
  expect_on_both_sides("asinh", [](auto x) { return asinh(x) + atanh(x) + acosh(2.0 + x); });
  expect_on_both_sides("exp", [](auto x) { return exp(x) + exp2(x) + expm1(x); });
  expect("log", [](auto x) { return log(x) + log2(x) + log10(x) + log1p(x); });
  expect_on_both_sides("erf", [](auto x) { return erf(x); });
  expect_on_both_sides("floor", [](auto x) { return floor(3.0 * x) + ceil(3.0 * x) + trunc(3.0 * x); });
  expect_on_both_sides("fmod", [](auto x) { return fmod(x * x * x, 0.4); });
  expect_on_both_sides("fmod of a number", [](auto x) { return fmod(5.35, x); });
  expect_on_both_sides("fmod of two", [](auto x) { return fmod(x * x * x, 0.3 + 0.1 * x); });
  expect_on_both_sides("copysign", [](auto x) { return copysign(x * x, x) + copysign(2.0, x) + copysign(x, -1.0); });
  expect_on_both_sides("min", [](auto x) { return min(x, 0.0) + min(0.5, x) + min(x, x * x); });
  expect_on_both_sides("max", [](auto x) { return max(x, 0.0) + max(0.5, x) + max(x, x * x); });
  expect_on_both_sides("sign", [](auto x) { return sign(x, -1.0) + sign(x * x, x); });
  expect_on_both_sides("step", [](auto x) { return step(x, -0.5, 1.0, 0.6, 3.0) + step5(x, -0.5, 1.0, 0.6, -3.0); });
  expect_on_both_sides("havsin", [](auto x) { return havsin(x, -0.5, 1.0, 0.6, 3.0); });
  expect_on_both_sides("impact", [](auto x) { return impact(x, x * x - 2.0, 0.4, 10.0, 2.2, 0.3, 0.2); });
  expect_on_both_sides("bistop", [](auto x) { return bistop(x, x - 0.1, -0.5, 0.4, 10.0, 1.5, 0.3, 0.2); });
  expect_on_both_sides("comparisons", [](auto x) { return x == x && !(x != x) && x > -2.0 ? +x : -x; });
}

TEST(FormulaFunctions, of_the_language_are_what_they_are_there) {
  using namespace dynalin::user;  // NOLINT
  EXPECT_EQ(step(0.25, 0, 1, 1, 3), 1 + 2 * (0.25 * 0.25 * 2.5));
  EXPECT_EQ(step(-1.0, 0, 1, 1, 3), 1);
  EXPECT_EQ(step(2.0, 0, 1, 1, 3), 3);
  EXPECT_NEAR(step5(0.25, 0, 1, 1, 3), 1 + 2 * (0.015625 * (10 - 3.75 + 0.375)), 1e-15);
  EXPECT_NEAR(havsin(0.5, 0, 1, 1, 3), 2, 1e-15);
  EXPECT_EQ(impact(0.4, -1.0, 0.4, 10, 1, 3, 0.1), 0);
  EXPECT_NEAR(impact(0.3, -1.0, 0.4, 10, 1, 3, 0.2), 1 + 1.5, 1e-15);
  EXPECT_EQ(impact(0.3, 10.0, 0.4, 10, 1, 3, 0.2), 0);
  EXPECT_NEAR(bistop(0.7, 1.0, 0.4, 0.6, 10, 1, 3, 0.2), -(1 + 1.5), 1e-14);
  EXPECT_EQ(bistop(0.5, 1.0, 0.4, 0.6, 10, 1, 3, 0.2), 0);
  EXPECT_EQ(sign(-2.0, 3.0), 2);
}

}  // namespace
}  // namespace dynalin::cases::formula_functions_test

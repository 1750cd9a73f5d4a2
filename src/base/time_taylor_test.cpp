#include "base/time_taylor.h"

#include <gtest/gtest.h>

#include <random>

namespace dynalin::time_taylor_test {
namespace {

using Number = Dual<5>;

// Partials in one pass are those of the three formulas over dual numbers, digit for digit.
TEST(TimeTaylor, product_is_that_of_its_formulas_over_duals) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-3, 3);
  const auto drawn = [&] {
    Number n(any(random));
    for (double& p : n.partial) p = any(random);
    return n;
  };
  for (int k = 0; k < 50; ++k) {
    const TimeTaylor<Number> a(drawn(), drawn(), drawn()), b(drawn(), drawn(), drawn()), ab = a * b;
    const auto expect_same = [](const Number& given, const Number& expected) {
      EXPECT_EQ(given.value, expected.value);
      EXPECT_EQ(given.partial, expected.partial);
    };
    expect_same(ab.value, a.value * b.value);
    expect_same(ab.rate, a.rate * b.value + a.value * b.rate);
    expect_same(ab.acceleration, a.acceleration * b.value + 2.0 * (a.rate * b.rate) + a.value * b.acceleration);
  }
}

// What differentiation has used up stays missing.
TEST(TimeTaylor, product_misses_what_one_of_both_misses) {
  const TimeTaylor<Number> a(Number(2, 0), Number(3, 1), Number(4, 2)), ab = differentiate(a) * a;
  EXPECT_FALSE(std::isnan(ab.rate.value) || std::isnan(ab.rate.partial[1]));
  EXPECT_TRUE(std::isnan(ab.acceleration.value));
  for (const double p : ab.acceleration.partial) EXPECT_TRUE(std::isnan(p));
}

}  // namespace
}  // namespace dynalin::time_taylor_test

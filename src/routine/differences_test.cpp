// Slopes by differences: of smooth laws to rounding, of values in few digits as well as those allow, and none of jumps.
#include "routine/differences.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dynalin::differences_test {
namespace {

Slope slope_of(double (*f)(double), double x) {
  return extrapolated_slope([f](double at, std::span<double> y) { y[0] = f(at); }, x, 1).front();
}

TEST(Differences, of_smooth_laws_are_right_to_rounding) {
  for (const double x : {-3.0, -0.1, 0.0, 0.4, 2.0, 50.0}) {
    const Slope sine = slope_of([](double t) { return std::sin(t); }, x);
    EXPECT_TRUE(sine.agreed) << x;
    EXPECT_NEAR(sine.value, std::cos(x), 1e-10) << x;
    EXPECT_EQ(sine.half_kink, 0) << x;
    const Slope steep = slope_of([](double t) { return std::tanh(1e4 * (t - 0.4)); }, x);
    EXPECT_NEAR(steep.value, x == 0.4 ? 1e4 : 0.0, 1e-4) << x;
  }
  EXPECT_EQ(slope_of([](double) { return 3.0; }, 1).value, 0);
}

// Steps that are smaller than the grains of the values see nothing, or everything, and agree with each other by chance.
TEST(Differences, of_single_precision_are_not_those_of_its_grains) {
  const auto close = [](double (*f)(double), double slope) {
    for (int k = 0; k < 1000; ++k) {
      const double x = 0.05 + 0.003 * k;
      const Slope found = slope_of(f, x);
      EXPECT_TRUE(found.agreed) << x;
      EXPECT_NEAR(found.value, slope, 0.01 * std::abs(slope)) << x;
    }
  };
  close([](double x) { return double(-0.1F * static_cast<float>(x * 1000.0)); }, -100);
  close([](double x) { return double(-100.0F * (static_cast<float>(x) - 0.1F)); }, -100);
  close([](double x) { return double(-100.0F * (static_cast<float>(x) * 1.7F) / 1.7F); }, -100);
}

TEST(Differences, see_a_law_that_is_flat_only_near_by) {
  // 0 within a thousandth, then a slope of 5: no grains, though small steps see nothing.
  const auto gap = [](double x) { return x > 1e-3 ? 5 * (x - 1e-3) : x < -1e-3 ? 5 * (x + 1e-3) : 0.0; };
  for (const double x : {0.0, 5e-4, -9e-4}) EXPECT_EQ(slope_of(gap, x).value, 0) << x;
  for (const double x : {1.1e-3, 0.5}) EXPECT_NEAR(slope_of(gap, x).value, 5, 1e-9) << x;
}

TEST(Differences, name_a_kink_and_refuse_a_jump) {
  const auto damper = [](double v) { return v > 0 ? 100 * v : 300 * v; };
  const Slope kink = slope_of(damper, 0);
  EXPECT_TRUE(kink.agreed);
  EXPECT_NEAR(kink.value, 200, 1e-9);
  EXPECT_NEAR(kink.half_kink, -100, 1e-9);
  for (const double beside : {1e-8, -1e-8, 1e-3}) {
    EXPECT_NEAR(slope_of(damper, beside).value, beside > 0 ? 100 : 300, 1e-6) << beside;
    EXPECT_EQ(slope_of(damper, beside).half_kink, 0) << beside;
  }
  EXPECT_FALSE(slope_of([](double x) { return x > 0 ? 1.0 : -1.0; }, 0).agreed);
}

}  // namespace
}  // namespace dynalin::differences_test

// Slopes by differences: of smooth laws to rounding, of values in few digits as well as those allow, and none of jumps.
#include "routine/differences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

// Wide steps agree with each other and know nothing of it.
TEST(Differences, see_a_law_that_is_another_one_near_by) {
  for (const double a : {0.5, 5e-3, 2.5e-3, 5e-4, 1e-4, 1e-5, 1e-6}) {
    const auto near = [&](const auto& law) {
      return extrapolated_slope([&](double x, std::span<double> y) { y[0] = law(x); }, 0, 1).front();
    };
    const auto expect = [&](const Slope& found, double slope) {
      EXPECT_TRUE(found.agreed) << a;
      EXPECT_NEAR(found.value, slope, 1e-9 * std::abs(slope)) << a;
    };
    const auto detent = [&](double x) { return std::abs(x) < a ? -1e5 * x * std::pow(1 - x * x / (a * a), 2) : 0.0; };
    expect(near(detent), -1e5);
    expect(near([&](double x) { return detent(x) - 70 * x; }), -1e5 - 70);
    expect(near([&](double v) { return -10 * v - 2 * (v / a) * std::exp(-(v / a) * (v / a)); }), -10 - 2 / a);
    const Slope ridge = near([&](double x) { return 1e3 * std::max(0.0, a - std::abs(x)); });
    EXPECT_NEAR(ridge.half_kink, -1e3, 1e-6) << a;
  }
  // Steps that are parts of a power of two end where the sine does.
  for (const double n : {1.0, 100.0, 512.0, 1024.0, 2048.0, 65536.0}) {
    for (const double x : {0.0, 0.25}) {
      const auto cogging = [&](double at, std::span<double> y) {
        y[0] = -100 * at - 0.05 * std::sin(2 * std::numbers::pi * n * at);
      };
      const double slope = -100 - 0.1 * std::numbers::pi * n * std::cos(2 * std::numbers::pi * n * x);
      EXPECT_NEAR(extrapolated_slope(cogging, x, 1).front().value, slope, 1e-7 * std::abs(slope)) << n << " " << x;
    }
  }
}

TEST(Differences, of_values_with_noise_are_not_taken_for_another_law) {
  for (const double x : {0.0, 0.3, 0.7, -2.0, 50.0, 1000.0}) {
    const Slope rest = slope_of([](double t) { return 1e9 * (t - 0.3) + 1e3 * std::sin(t) - 1e9 * (t - 0.3); }, x);
    EXPECT_TRUE(rest.agreed) << x;
    EXPECT_NEAR(rest.value, 1e3 * std::cos(x), 0.01) << x;
    EXPECT_NEAR(slope_of([](double t) { return std::pow(std::cos(t), 2) + std::pow(std::sin(t), 2); }, x).value, 0,
                1e-9)
        << x;
  }
}

// How often a smooth law is called for.
TEST(Differences, take_few_steps_on_smooth_laws) {
  int calls = 0;
  extrapolated_slope([&](double x, std::span<double> y) { y[0] = std::sin(x), ++calls; }, 0.4, 1);
  EXPECT_LE(calls, 17);
}

// The quotient falls with the step, as slowly as the step to one half.
TEST(Differences, that_fall_to_nothing_are_a_slope_of_zero) {
  const auto zero = [](double (*f)(double)) {
    const Slope found = slope_of(f, 0);
    EXPECT_TRUE(found.agreed);
    EXPECT_NEAR(found.value, 0, 1e-8);
    EXPECT_EQ(found.half_kink, 0);
  };
  zero([](double v) { return -5 * v * std::abs(v); });
  zero([](double v) { return std::copysign(std::pow(std::abs(v), 1.5), v); });
  zero([](double v) { return -3 * std::pow(std::abs(v), 1.5); });
  zero([](double v) { return v < 0 ? 0 : -5 * v * v; });
  zero([](double x) { return x < 0 ? 0 : 1e10 * std::pow(x, 1.5); });
  zero([](double x) { return x < 0 ? 0 : 1e5 * std::pow(x, 2.2); });
  zero([](double x) { return x * std::pow(std::abs(x), 2.5); });
  zero([](double x) { return 5 + std::copysign(std::pow(std::abs(x), 1.5), x); });
  zero([](double x) { return x * std::abs(x) + std::copysign(std::pow(std::abs(x), 1.5), x); });
  const Slope beside = slope_of([](double x) { return -x - 300 * std::copysign(std::pow(std::abs(x), 1.5), x); }, 0);
  EXPECT_TRUE(beside.agreed);
  EXPECT_NEAR(beside.value, -1, 1e-9);
  // Close to that point as well.
  for (const double v : {-1e-6, 1e-8, -1e-9, 1e-10, -1e-12}) {
    const Slope drag = slope_of([](double u) { return -5 * u * std::abs(u); }, v);
    EXPECT_TRUE(drag.agreed) << v;
    EXPECT_NEAR(drag.value, -10 * std::abs(v), 2e-9) << v;
    EXPECT_FALSE(contradicts(drag, -10 * std::abs(v))) << v;
  }
  // What else is there is told.
  const Slope kink = slope_of([](double x) { return 5 * std::abs(x) + x * std::abs(x); }, 0);
  EXPECT_NEAR(kink.half_kink, 5, 1e-6);
  for (const double height : {1.0, 1e-3, 1e-9}) {
    const auto jump = [&](double x, std::span<double> y) { y[0] = std::copysign(height, x) + x * std::abs(x); };
    EXPECT_FALSE(extrapolated_slope(jump, 0, 1).front().agreed) << height;
  }
  EXPECT_FALSE(slope_of([](double x) { return std::copysign(std::sqrt(std::abs(x)), x); }, 0).agreed);
}

TEST(Differences, contradict_nothing_that_is_lost_in_rounding) {
  const Slope none{0, 0, true};
  EXPECT_TRUE(contradicts(none, 1e-16));
  EXPECT_FALSE(contradicts(none, 1e-16, 0.5, 2));
  EXPECT_FALSE(contradicts(none, 1e-16, -100, 200));
  EXPECT_TRUE(contradicts(none, 1e-9, 0.5, 2));
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

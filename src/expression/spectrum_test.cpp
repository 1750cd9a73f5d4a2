#include "expression/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "expression/expression_test_support.h"
#include "expression/functions.h"
#include "expression/spline.h"

namespace dynalin::expression_test::spectrum_test {
namespace {

SplineData points(std::vector<double> x, double (*density)(double)) {
  SplineData d{std::move(x), {}, {{}}, false};
  for (const double f : d.x) d.y[0].push_back(density(f));
  return d;
}

// The mean of g(y, y′) over a period, exact for trigonometric polynomials of less than `samples` cycles in it.
template <class G>
double mean(const HarmonicSignal& s, double period, G g) {
  constexpr int samples = 512;
  double sum = 0;
  for (int k = 0; k < samples; ++k) {
    const TimeTaylor<double> y = s.at(TimeTaylor<double>(period * k / samples, 1.0, 0.0));
    sum += g(y.value, y.rate) / samples;
  }
  return sum;
}
double mean_square(const HarmonicSignal& s, double period) {
  return mean(s, period, [](double y, double) { return y * y; });
}

TEST(Spectrum, mean_square_is_the_area_under_the_density) {
  // Bands of 1/2 around 1/4, 3/4 …: the signal repeats after 4.
  const SplineData flat = points({0, 2, 5, 10}, [](double) { return 2.0; });
  EXPECT_NEAR(mean_square(HarmonicSignal(flat, {0, 5, 10, false, 3}), 4), 10, 1e-12);
  EXPECT_NEAR(mean(HarmonicSignal(flat, {0, 5, 10, false, 3}), 4, [](double y, double) { return y; }), 0, 1e-13);
  const SplineData line = points({0, 2, 5, 10}, [](double f) { return 3 * f; });
  EXPECT_NEAR(mean_square(HarmonicSignal(line, {1, 4, 6, false, 3}), 4), 22.5, 1e-12);
  // Bands of 1 around 3/2, 5/2, 7/2: it repeats after 2. Powers of f are lines in the logarithms.
  const SplineData square = points({1, 2, 4, 8}, [](double f) { return 1 / (f * f); });
  EXPECT_NEAR(mean_square(HarmonicSignal(square, {1, 4, 3, true, 3}), 2), 0.75, 1e-13);
  const SplineData inverse = points({1, 2, 4, 8}, [](double f) { return 1 / f; });
  EXPECT_NEAR(mean_square(HarmonicSignal(inverse, {1, 4, 3, true, 3}), 2), std::log(4.0), 1e-13);
  // Straight lines between the same points hold more: trapezia from 1 to 2 and from 2 to 4.
  EXPECT_NEAR(mean_square(HarmonicSignal(inverse, {1, 4, 3, false, 3}), 2), 0.75 + 0.75, 1e-13);
}

TEST(Spectrum, is_zero_beyond_its_points) {
  const SplineData d = points({1, 2, 3, 4}, [](double) { return 2.0; });
  EXPECT_NEAR(mean_square(HarmonicSignal(d, {0, 8, 16, false, 3}), 4), 6, 1e-12);
}

// Two bands, so that each amplitude is checked by itself: ∫ over the band = A²/2.
TEST(Spectrum, amplitudes_frequencies_and_phases_are_those_of_the_bands) {
  const SplineData line = points({0, 2, 5, 10}, [](double f) { return f; });
  const HarmonicSignal s(line, {1, 3, 2, false, 0});
  ASSERT_EQ(s.harmonics().size(), 2u);
  EXPECT_NEAR(s.harmonics()[0].amplitude, std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(s.harmonics()[1].amplitude, std::sqrt(5.0), 1e-14);
  EXPECT_EQ(s.harmonics()[0].frequency, 1.5);
  EXPECT_EQ(s.harmonics()[1].frequency, 2.5);
  // The first numbers of SplitMix64 from 0, as published: e220a8397b1dcdaf, 6e789e6aa1b965f4.
  const double turn = 2 * std::numbers::pi;
  EXPECT_EQ(s.harmonics()[0].phase, turn * (static_cast<double>(0xe220a8397b1dcdafu >> 11) * 0x1p-53));
  EXPECT_EQ(s.harmonics()[1].phase, turn * (static_cast<double>(0x6e789e6aa1b965f4u >> 11) * 0x1p-53));
  EXPECT_NEAR(s.at(0.0),
              std::sqrt(3.0) * std::sin(s.harmonics()[0].phase) + std::sqrt(5.0) * std::sin(s.harmonics()[1].phase),
              1e-14);
  EXPECT_NE(HarmonicSignal(line, {1, 3, 2, false, 1}).harmonics()[0].phase, s.harmonics()[0].phase);
}

TEST(Spectrum, mean_square_of_the_rate_weighs_with_the_square_of_the_frequency) {
  const SplineData flat = points({0, 2, 5, 10}, [](double) { return 2.0; });
  double expected = 0;
  for (int k = 0; k < 10; ++k) expected += std::pow(2 * std::numbers::pi * (0.25 + 0.5 * k), 2);
  EXPECT_NEAR(mean(HarmonicSignal(flat, {0, 5, 10, false, 3}), 4, [](double, double v) { return v * v; }), expected,
              1e-11 * expected);
}

TEST(Spectrum, call_reads_its_constants_and_is_differentiated) {
  const ParsedText parsed = parse("3*INVPSD(2*DX(1,2), 7, 1, 3, 1+1, 0, 5.9)");
  ASSERT_FALSE(parsed.diagnostics.has_errors()) << render(parsed.diagnostics);
  ASSERT_EQ(parsed.expression.splines().size(), 1u);
  const SplineUse& use = parsed.expression.splines()[0];
  EXPECT_EQ(use.id, 7);
  EXPECT_EQ(use.spectrum->count, 2);
  EXPECT_EQ(use.spectrum->seed, 5);
  EXPECT_FALSE(use.spectrum->logarithmic);
  EXPECT_EQ(use.id_at.text(), "7");
  const HarmonicSignal s(points({0, 2, 5, 10}, [](double f) { return f; }), *use.spectrum);
  const Expression attached =
      parsed.expression.with_curves([&](SplineUse& u) { u.signal = std::make_shared<const HarmonicSignal>(s); });
  double value = 0, slope = 0;
  for (const auto& h : s.harmonics()) {
    const double w = 2 * std::numbers::pi * h.frequency;
    value += h.amplitude * std::sin(w * 0.6 + h.phase);
    slope += h.amplitude * w * std::cos(w * 0.6 + h.phase);
  }
  const auto r = evaluate<double>(attached, {0.3});
  EXPECT_NEAR(r.value, 3 * value, 1e-13);
  EXPECT_NEAR(r.partial[0], 6 * slope, 1e-12);
}

TEST(Spectrum, data_that_are_no_density_are_told) {
  EXPECT_EQ(why_no_spectrum(points({0, 1, 2, 3}, [](double) { return 1.0; }), false), "");
  EXPECT_EQ(why_no_spectrum(points({0, 1, 2, 3}, [](double) { return 1.0; }), true), "value 1 of X is 0");
  EXPECT_EQ(why_no_spectrum(points({-1, 1, 2, 3}, [](double) { return 1.0; }), false), "value 1 of X is -1");
  EXPECT_EQ(why_no_spectrum(points({0, 1, 2, 3}, [](double f) { return 1 - f; }), false), "value 3 of Y is -1");
  EXPECT_EQ(why_no_spectrum(points({1, 2, 3, 4}, [](double f) { return 2 - f; }), true), "value 2 of Y is 0");
  SplineData family = points({0, 1, 2, 3}, [](double) { return 1.0; });
  family.y.push_back(family.y[0]), family.z = {0, 1};
  EXPECT_EQ(why_no_spectrum(family, false), "it is a family of curves");
}

}  // namespace
}  // namespace dynalin::expression_test::spectrum_test

// Loads at which beams of finite elements lose their stability, as LINEAR tells it: published values.
#include <dynalin/study.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/fe_parts.h"
#include "cases/study_of.h"

namespace dynalin::cases::fe_part_stability_test {
namespace {

// Squares of the eigenvalues [1/time²] of an upper half plane, those nearest to zero first.
std::vector<std::complex<double>> squares(const std::string& dataset) {
  const auto study = study_of(dataset);
  std::vector<std::complex<double>> list;
  for (const EigenMode& m : study.linearize(study.static_equilibrium()).modes(library::ModeShapes::left_out).modes) {
    const std::complex<double> s = 2 * std::numbers::pi * m.eigenvalue_hz;
    if (s.imag() > 0 || s.real() > 0) list.push_back(s * s);
  }
  std::ranges::sort(list, {}, [](std::complex<double> s) { return std::abs(s); });
  return list;
}
// Where a straight line through (a, fa) and (b, fb) meets zero.
double crossing(double a, double fa, double b, double fb) { return a + (b - a) * fa / (fa - fb); }

}  // namespace

// A force at the tip of a narrow strip, in its plane: 4.0126 √(EI GJ)/L² (Prandtl 1899, Michell 1899). The strip is 80
// times as deep as it is thick, so that it hardly bends before it tips over.
TEST(FePartStability, a_narrow_cantilever_tips_over_under_prandtls_load) {
  const double h = 0.08, t = 0.001, weak = h * t * t * t / 12, J = 4 * weak;
  const auto least = [&](double part) {
    StraightBeam beam{.elements = 8, .height = h, .width = t, .further = fmt::format(", IXX={:.17g}", J)};
    const double EI = beam.modulus() * weak, GJ = beam.modulus() / 2.6 * J;
    return squares(clamped_beam(
        beam, fmt::format("VFORCE/1, I=22, JFLOAT=2, RM=1, FY={:.17g}\n", -part * 4.0126 * std::sqrt(EI * GJ))))[0];
  };
  // The lowest square goes to zero with the load, all frequencies real below.
  const std::complex<double> before = least(0.97), nearer = least(0.99);
  EXPECT_LT(before.real(), nearer.real());
  EXPECT_LT(nearer.real(), 0);
  EXPECT_NEAR(std::sqrt(crossing(0.97 * 0.97, before.real(), 0.99 * 0.99, nearer.real())), 1, 1e-3);
}

// A force on the tip that turns with it: 20.05 EI/L² (Beck 1952). No equilibrium beside the straight one exists; two
// frequencies meet at 11.016 √(EI/(ρA L⁴)) and leave the imaginary axis.
TEST(FePartStability, becks_column_flutters) {
  // Across it is stiff, so that the two lowest modes are those of one plane.
  const auto lowest = [](double P) {
    const StraightBeam beam{.elements = 8, .height = 2e-3, .width = 2e-2};
    auto list = squares(clamped_beam(
        beam, fmt::format("GFORCE/1, I=22, JFLOAT=2, RM=22, FX={:.17g}\\FY=0\\FZ=0\\TX=0\\TY=0\\TZ=0\n", -P)));
    return std::array{list[0], list[1]};
  };
  // The discriminant of the pair is nearly linear about its zero, whether both are real or conjugate.
  const auto discriminant = [](const std::array<std::complex<double>, 2>& s) {
    return ((s[0] - s[1]) * (s[0] - s[1])).real();
  };
  const auto below = lowest(19.95), above = lowest(20.15);
  for (const std::complex<double>& s : below) {
    EXPECT_LT(s.real(), 0);
    EXPECT_NEAR(s.imag(), 0, 1e-5 * std::abs(s));
  }
  EXPECT_GT(std::abs(above[0].imag()), 1);
  EXPECT_NEAR(std::abs(above[0]), std::abs(above[1]), 1e-6 * std::abs(above[0]));
  EXPECT_NEAR(crossing(19.95, discriminant(below), 20.15, discriminant(above)), 20.0509536, 6e-3);
  EXPECT_NEAR(std::sqrt(std::abs(above[0])), 11.0156, 0.06);
}

}  // namespace dynalin::cases::fe_part_stability_test

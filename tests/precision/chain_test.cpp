// Hanging chain of n rods with a damper in its top hinge: the low modes of a long chain against a transfer recurrence
// in 50 digits.
#include <dynalin/study.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "elements/catalogue.h"
#include "precision/precise.h"
#include "selected_modes/selected_modes.h"

namespace dynalin::precision::chain_test {
namespace {

using Complex =
    boost::multiprecision::number<boost::multiprecision::complex_adaptor<boost::multiprecision::cpp_bin_float<50>>,
                                  boost::multiprecision::et_off>;

constexpr double gravity = 9.81, damping = 1e-3;

std::string chain(int n) {
  std::string s = fmt::format("chain\nUNITS/SYSTEM=MKS\nACCGRAV/JGRAV={}\nPART/1, GROUND\nMARKER/1\n", -gravity);
  for (int k = 1; k <= n; ++k) {
    s += fmt::format(
        "PART/{0}, MASS={1:.17g}, CM={0}0, IP={2:.17g},{2:.17g},{2:.17g}, QG=0,{3:.17g},0\n"
        "MARKER/{0}0, QP=0,{4:.17g},0\nMARKER/{0}1\nMARKER/{0}2, QP=0,{5:.17g},0\n"
        "JOINT/{0}, REVOLUTE, I={0}1, J={6}\n",
        k + 1, 1.0 / n, 1.0 / 12 / n / n / n, -(k - 1.0) / n, -0.5 / n, -1.0 / n,
        k == 1 ? std::string("1") : fmt::format("{}2", k));
  }
  return s + fmt::format("SPRINGDAMPER/1, ROTATION, I=21, J=1, KT=0, CT={}\nEND\n", damping);
}

// Displacement of the top when the tip moves by one in e^{λt}; zero at an eigenvalue. Marches from the free tip
// upwards: x and H are the displacement of a hinge and the horizontal force on the rod above it.
Complex top(int n, const Complex& lambda) {
  const Real l = Real(1) / n, m = Real(1) / n, J = m * l * l / 12, g = Real(gravity);
  const Complex s = lambda * lambda;
  Complex x = 1, H = 0;
  for (int i = n; i >= 1; --i) {
    const Real below = m * g * (n - i), above = m * g * (n - i + 1);
    // J s θ = l/2 (H + H') − l/2 (T + T') θ − c λ θ of the top rod, with H' = H − m s (x − l θ/2).
    const Complex left =
        J * s + l / 2 * (below + above) - l * l / 4 * m * s + (i == 1 ? Real(damping) * lambda : Complex(0));
    const Complex theta = l / 2 * (2 * H - m * s * x) / left;
    H -= m * s * (x - l / 2 * theta);
    x -= l * theta;
  }
  return x;
}

Complex root(int n, Complex a) {
  Complex b = a * (1 + Real(1e-12)), fa = top(n, a), fb = top(n, b);
  for (int k = 0; k < 60 && abs(b - a) > Real("1e-40"); ++k) {
    const Complex next = b - fb * (b - a) / (fb - fa);
    a = b, fa = fb;
    b = next, fb = top(n, b);
    if (fb == fa) break;
  }
  return b;
}

class Chain : public ::testing::TestWithParam<int> {};

TEST_P(Chain, low_modes_have_all_their_digits) {
  const int n = GetParam();
  const auto solution = library::Study(library::Model::from_text(chain(n))).linearize().modes();
  int found = 0;
  const Real cycle = 2 * boost::math::constants::pi<Real>();
  for (const EigenMode& mode : solution.modes) {
    if (mode.is_real || found == 5) continue;
    ++found;
    const std::complex<double> start = mode.eigenvalue_hz;
    const Complex exact = root(n, Complex(Real(start.real()) * cycle, Real(start.imag()) * cycle)) / cycle;
    EXPECT_NEAR(static_cast<double>((Real(start.imag()) - exact.imag()) / exact.imag()), 0, 1e-12) << found;
    EXPECT_NEAR(static_cast<double>((Real(start.real()) - exact.real()) / exact.real()), 0, 1e-6) << found;
    EXPECT_LE(static_cast<double>(abs(exact - Complex(start.real(), start.imag()))),
              mode.error_bound_hz + 1e-12 * std::abs(start));
  }
  EXPECT_EQ(found, 5);
}
INSTANTIATE_TEST_SUITE_P(lengths, Chain, ::testing::Values(5, 100, 500));
// Minutes, and all the memory of its dense matrices (docs/performance.md): the test long_chain of ctest -C Long.
INSTANTIATE_TEST_SUITE_P(DISABLED_long, Chain, ::testing::Values(2000));

// Without the state matrix, and counted.
class SelectedOfChain : public ::testing::TestWithParam<int> {};

TEST_P(SelectedOfChain, modes_have_all_their_digits) {
  const int n = GetParam();
  auto dataset = parse_dataset(std::make_shared<const SourceText>("chain.adm", chain(n)));
  auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
  ASSERT_FALSE(model.diagnostics.has_errors());
  const auto system = System::make(std::move(model.value)).value();
  Findings findings;
  const auto point = initial_conditions(*system, findings);
  ASSERT_TRUE(point);
  const auto perturbation = perturb(*system, *point, {});
  ASSERT_TRUE(perturbation);
  const auto solution = eigensolve_selected(*system, *perturbation, NearestModes{10, 0});
  ASSERT_TRUE(solution) << solution.error().message;
  EXPECT_TRUE(solution->selected->complete);
  ASSERT_EQ(solution->modes.size(), 10u);
  const Real cycle = 2 * boost::math::constants::pi<Real>();
  for (const EigenMode& mode : solution->modes) {
    const std::complex<double> start = mode.eigenvalue_hz;
    const Complex exact = root(n, Complex(Real(start.real()) * cycle, Real(start.imag()) * cycle)) / cycle;
    if (!mode.is_real) {
      EXPECT_NEAR(static_cast<double>((Real(start.imag()) - exact.imag()) / exact.imag()), 0, 1e-12) << start;
    }
    EXPECT_NEAR(static_cast<double>((Real(start.real()) - exact.real()) / exact.real()), 0, 1e-6);
    // The numbers of the dataset are rounded as well.
    EXPECT_LE(static_cast<double>(abs(exact - Complex(start.real(), start.imag()))),
              mode.error_bound_hz + 1e-12 * std::abs(start));
  }
}
INSTANTIATE_TEST_SUITE_P(lengths, SelectedOfChain, ::testing::Values(50, 500, 2000));

}  // namespace
}  // namespace dynalin::precision::chain_test

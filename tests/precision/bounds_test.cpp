// The stated error bounds against 50-digit eigensolutions of the same assembled equations.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <tuple>

#include "eigenvalues/eigen.h"
#include "elements/catalogue.h"
#include "oracle/mechanism.h"
#include "places/draws.h"
#include "precision/precise.h"

namespace dynalin::precision::bounds_test {
namespace {

std::string listing(const std::vector<Value>& exact) {
  std::string s = "exact, rad:\n";
  for (const Value& v : exact)
    s += fmt::format("  {:.17g} {:.17g}\n", v.re.convert_to<double>(), v.im.convert_to<double>());
  return s;
}

Real least_distance(const std::vector<Value>& exact, const EigenMode& mode) {
  Real least = distance(exact.front(), mode.eigenvalue_hz);
  for (const Value& v : exact) least = std::min(least, distance(v, mode.eigenvalue_hz));
  return least;
}

class Bounds : public ::testing::Test {
 protected:
  // Every eigenvalue of the dataset: its bound over its error where there is one.
  void examine(const std::string& text) {
    auto dataset = parse_dataset(std::make_shared<const SourceText>("generated.adm", text));
    ASSERT_FALSE(dataset.diagnostics.has_errors()) << render(dataset.diagnostics) << text;
    auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
    ASSERT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
    const auto made = System::make(std::move(model.value)).value();
    const System& system = *made;
    Findings findings;
    const auto op = initial_conditions(system, findings);
    if (!op) {  // a draw whose accelerations have no solution
      ++refused_;
      return;
    }
    const auto linear = linearize(system, *op, {});
    ASSERT_TRUE(linear) << linear.error().message;
    if (linear->model.states.empty()) return;
    const auto solution = eigensolve(*linear);
    ASSERT_TRUE(solution) << solution.error().message;
    std::vector<Value> exact = eigenvalues(*linear->pencil);
    ASSERT_EQ(exact.size(), linear->model.states.size()) << text;
    const std::vector<Value> drawn = eigenvalues_within_rounding(*linear->pencil, random_);
    bool finer = false, zeros = false;
    for (const EigenMode& mode : solution->modes) {
      if (mode.structural_zero) {  // the equations hold it up to their rounding only
        zeros = true;
        continue;
      }
      ++examined_;
      // A rate along a motion that nothing holds shares a Jordan block with it: rounding of the equations, which the
      // product takes out with the motion, moves both by its root.
      if (zeros && std::abs(mode.eigenvalue_hz) < 1e-20) {
        EXPECT_LE(least_distance(exact, mode), Real(1e-6)) << text;
        continue;
      }
      // 50 digits of equations of size one are themselves good to 1e-45.
      const Real bound = Real(mode.error_bound_hz) + Real("1e-45");
      Real error = least_distance(exact, mode);
      if (error > bound && !finer) {
        finer = true;
        exact.clear();
        for (const FinerValue& v : finer_eigenvalues(*linear->pencil)) exact.push_back({Real(v.re), Real(v.im)});
        ASSERT_FALSE(exact.empty()) << text;
        error = least_distance(exact, mode);
      }
      EXPECT_LE(error, bound) << mode.eigenvalue_hz << " condition " << mode.condition << " refined " << mode.refined
                              << "\n"
                              << listing(exact) << text;
      if (!std::isfinite(mode.error_bound_hz)) ++unbounded_;
      if (!drawn.empty()) ratio_.push_back(static_cast<double>(bound / (least_distance(drawn, mode) + Real("1e-45"))));
    }
  }
  void TearDown() override {
    ASSERT_FALSE(ratio_.empty());
    std::nth_element(ratio_.begin(), ratio_.begin() + static_cast<std::ptrdiff_t>(ratio_.size() / 2), ratio_.end());
    const double median = ratio_[ratio_.size() / 2];
    RecordProperty("eigenvalues", examined_);
    RecordProperty("median_of_bound_over_error", fmt::format("{:.3g}", median));
    // Bounds cover the rounding of coefficients: what is off is the distance to equations with others of the same
    // digits, not to those that stand there.
    EXPECT_LE(median, most_median_);
    EXPECT_LE(unbounded_, examined_ / 100);
    EXPECT_LE(refused_, 1);
  }

  double most_median_ = 1000;
  int examined_ = 0, unbounded_ = 0, refused_ = 0;
  std::vector<double> ratio_;
  std::mt19937_64 random_{4};
};

class GeneratedBounds : public Bounds, public ::testing::WithParamInterface<std::uint64_t> {};

TEST_P(GeneratedBounds, hold_for_generated_mechanisms) {
  for (const std::uint64_t seed : drawn_seeds(GetParam(), GetParam() + 99)) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    examine(oracle::dataset_text(oracle::random_mechanism(seed)));
    if (HasFatalFailure() || HasFailure()) return;
  }
}
INSTANTIATE_TEST_SUITE_P(seeds, GeneratedBounds, ::testing::Range<std::uint64_t>(1001, 2001, 100));

// The nodes of a beam weigh little beside what they carry, and a bound from the sizes of all coefficients is wider
// there.
TEST_F(Bounds, hold_for_beams_of_finite_elements) {
  most_median_ = 10000;
  for (std::uint64_t seed = 241; seed < 251; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    examine(oracle::dataset_text(oracle::random_mechanism(seed)));
  }
}

// Slides on a line, coupled by springs and dampers whose sizes spread over many decades.
std::string stiff_chain(std::mt19937_64& random, int n, double decades) {
  const auto spread = [&] {
    return std::pow(10.0, std::uniform_real_distribution<double>(-decades / 2, decades / 2)(random));
  };
  std::string s = "chain of slides\nPART/1, GROUND\nMARKER/1, REULER=1.5707963267948966,1.5707963267948966,0\n";
  for (int k = 2; k <= n + 1; ++k) {
    s += fmt::format(
        "PART/{0}, MASS={1:.17g}, CM={0}0, IP=1,1,1, QG={2},0,0\nMARKER/{0}0\nMARKER/{0}1, "
        "REULER=1.5707963267948966,1.5707963267948966,0\n"
        "JOINT/{0}, TRANSLATIONAL, I={0}1, J=1\n"
        "SPRINGDAMPER/{0}, TRANSLATION, I={0}0, J={3}, K={4:.17g}, C={5:.17g}, LENGTH=1\n",
        k, spread(), k - 1, k == 2 ? "1" : fmt::format("{}0", k - 1), spread(), 0.01 * spread());
  }
  return s + "END\n";
}

void stiff_chains(const std::function<void(const std::string&)>& examine) {
  std::mt19937_64 random(20);
  for (int k = 0; k < 160; ++k) {
    examine(stiff_chain(random, 2 + k % 7, 2.0 + k % 15));
  }
}

// Two slides in a row, the first on a spring of stiffness a to the ground, the second on one of stiffness b to the
// first.
std::string two_slides(double a, double b, double m1, double m2) {
  std::string s = "two slides\nPART/1, GROUND\nMARKER/1, REULER=1.5707963267948966,1.5707963267948966,0\n";
  for (const auto& [k, mass, stiffness] : {std::tuple(2, m1, a), std::tuple(3, m2, b)}) {
    s += fmt::format(
        "PART/{0}, MASS={1:.17g}, CM={0}0, IP=1,1,1, QG={2},0,0\nMARKER/{0}0\nMARKER/{0}1, "
        "REULER=1.5707963267948966,1.5707963267948966,0\n"
        "JOINT/{0}, TRANSLATIONAL, I={0}1, J=1\n"
        "SPRINGDAMPER/{0}, TRANSLATION, I={0}0, J={3}, K={4:.17g}, LENGTH=1\n",
        k, mass, k - 1, k == 2 ? "1" : "20", stiffness);
  }
  return s + "END\n";
}
// ω² of the slow mode and of the fast one.
std::array<Real, 2> squares_of_two_slides(double a, double b, double m1, double m2) {
  const Real A = a, B = b, M = m1, N = m2, sum = (A + B) / M + B / N, product = A * B / (M * N);
  const Real fast = (sum + sqrt(sum * sum - 4 * product)) / 2;
  return {product / fast, fast};
}

// The coefficients are sums of the data, and rounded: that is part of the bounds.
TEST(DataBounds, a_soft_spring_beside_stiff_ones) {
  std::mt19937_64 random(5);
  const auto drawn = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(random));
  };
  int inexact = 0;
  for (int k = 0; k < 300; ++k) {
    const double a = drawn(-12, 0), b = drawn(0, 4), m1 = drawn(-1, 1), m2 = drawn(-1, 1);
    auto dataset = parse_dataset(std::make_shared<const SourceText>("drawn.adm", two_slides(a, b, m1, m2)));
    auto model = build_model(std::make_shared<const Dataset>(std::move(dataset.value)), catalogue());
    ASSERT_FALSE(model.diagnostics.has_errors()) << render(model.diagnostics);
    const auto made = System::make(std::move(model.value)).value();
    const System& system = *made;
    Findings findings;
    const auto op = initial_conditions(system, findings);
    ASSERT_TRUE(op);
    const auto linear = linearize(system, *op, {});
    ASSERT_TRUE(linear) << linear.error().message;
    const auto solution = eigensolve(*linear);
    ASSERT_TRUE(solution);
    std::vector<Value> exact;
    for (const Real& square : squares_of_two_slides(a, b, m1, m2)) exact.push_back({0, sqrt(square)});
    for (const EigenMode& mode : solution->modes) {
      const Real error = least_distance(exact, mode);
      EXPECT_LE(error, Real(mode.error_bound_hz)) << two_slides(a, b, m1, m2);
      inexact += error > 1e-14 * std::abs(mode.eigenvalue_hz);
    }
  }
  EXPECT_GT(inexact, 50) << "the draws do not show what they are for";
}

// A slide whose damping misses the critical one by a part in 10^k: two eigenvalues that nearly are one, with one
// vector.
void near_critical_damping(const std::function<void(const std::string&)>& examine) {
  for (int k = 0; k < 120; ++k) {
    const double off = (k % 2 ? 1 : -1) * std::pow(10.0, -k / 8.0), stiffness = 100.0 * (1 + k % 5);
    examine(
        fmt::format("slide\nPART/1, GROUND\nMARKER/1, REULER=1.5707963267948966,1.5707963267948966,0\n"
                    "PART/2, MASS=1, CM=20, IP=1,1,1, QG=1,0,0\nMARKER/20\nMARKER/21, "
                    "REULER=1.5707963267948966,1.5707963267948966,0\n"
                    "JOINT/1, TRANSLATIONAL, I=21, J=1\n"
                    "SPRINGDAMPER/1, TRANSLATION, I=20, J=1, K={:.17g}, C={:.17g}, LENGTH=1\nEND\n",
                    stiffness, 2 * std::sqrt(stiffness) * (1 + off)));
  }
}

// Lags in series: a chain of equal or nearly equal eigenvalues.
void lags_in_series(const std::function<void(const std::string&)>& examine) {
  for (int k = 0; k < 120; ++k) {
    std::string s = "lags\nPART/1, GROUND\n";
    const int n = 2 + k % 3;
    const double off = k % 4 == 0 ? 0.0 : std::pow(10.0, -k / 10.0);
    for (int i = 1; i <= n; ++i) {
      s += fmt::format("VARIABLE/{0}, FUNCTION={1}\nDIFF/{0}, IC=1, FUNCTION=VARVAL({0})-{2:.17g}*DIF({0})\n", i,
                       i == 1 ? "0" : fmt::format("{}*DIF({})", 3 * i, i - 1), 2 * (1 + i * off));
    }
    examine(s + "END\n");
  }
}

TEST_F(Bounds, hold_for_ill_conditioned_models) {
  const auto each = [this](const std::string& text) {
    if (!HasFailure()) examine(text);
  };
  stiff_chains(each);
  near_critical_damping(each);
  lags_in_series(each);
}

}  // namespace
}  // namespace dynalin::precision::bounds_test

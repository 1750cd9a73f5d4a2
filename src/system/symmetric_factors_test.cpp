#include "system/symmetric_factors.h"

#include <gtest/gtest.h>

#include <random>

#include "system/sparse_lu.h"

namespace dynalin::symmetric_factors_test {
namespace {

// A row of masses on springs with every second one held by a multiplier, less a multiple of the masses: the negative
// pivots are as many as multipliers and values below.
TEST(SymmetricFactors, count_negative_eigenvalues_and_solve) {
  constexpr std::int32_t n = 60, held = n / 2;
  std::vector<Triplet> entries;
  for (std::int32_t k = 0; k < n; ++k) {
    entries.push_back({k, k, 2.0});
    if (k > 0) entries.push_back({k, k - 1, -1.0});
  }
  for (std::int32_t k = 0; k < held; ++k) entries.push_back({n + k, 2 * k, 3.0});
  const ColumnMatrix lower = compressed(n + held, n + held, entries);
  SymmetricFactors factors(lower), solving(lower, FactorsFor::solving);
  // What is left: thirty masses, each with 2 − σ.
  for (const double sigma : {1.5, 2.5, -1.0}) {
    std::vector<double> value;
    for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double v) { value.push_back(r == c ? v - sigma : v); });
    ASSERT_TRUE(factors.factor(value) && solving.factor(value));
    EXPECT_EQ(factors.negative_pivots(), held + (sigma > 2 ? n - held : 0));
    std::mt19937 random(1);
    Eigen::MatrixXd x(n + held, 2), b = Eigen::MatrixXd::Zero(n + held, 2);
    for (double& e : x.reshaped()) e = static_cast<double>(random() % 100);
    std::size_t k = 0;
    for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double) {
      b.row(r) += value[k] * x.row(c);
      if (r != c) b.row(c) += value[k] * x.row(r);
      ++k;
    });
    Eigen::MatrixXd again = b;
    factors.solve(b), solving.solve(again);
    EXPECT_LT((b - x).norm(), 1e-12 * x.norm());
    EXPECT_LT((again - x).norm(), 1e-12 * x.norm());
  }
}

}  // namespace
}  // namespace dynalin::symmetric_factors_test

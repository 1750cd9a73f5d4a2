#include "system/symmetric_factors.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
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

Eigen::MatrixXd dense(const ColumnMatrix& lower) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(lower.rows, lower.rows);
  for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double v) { A(r, c) = A(c, r) = v; });
  return A;
}
std::int64_t negative_values(const Eigen::MatrixXd& A) {
  return (Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues().array() < 0).count();
}

// det = ε − 1 of the upper left block and ε − 1 of all: one is negative. In the order given, 1/ε swallows all else.
TEST(SymmetricFactors, exchange_rows_where_a_small_pivot_spoils_what_follows) {
  for (const double least : {1e-3, 1e-8, 1e-15, 3e-16, 7e-17, 1e-20, 0.0}) {
    const std::vector<Triplet> entries = {{0, 0, least}, {1, 0, 1.0}, {2, 0, 1.0},
                                          {1, 1, 1.0},   {2, 1, 1.0}, {2, 2, 2.0}};
    const ColumnMatrix lower = compressed(3, 3, entries);
    SymmetricFactors factors(lower);
    ASSERT_TRUE(factors.factor(lower.value)) << least;
    EXPECT_EQ(factors.negative_pivots(), 1) << least;
    Eigen::MatrixXd x = Eigen::Vector3d(1, 2, 3), b = dense(lower) * x;
    factors.solve(b);
    EXPECT_LT((b - x).norm(), 1e-10) << least;
  }
}

// Chains of bodies of all sizes, with multipliers between neighbours, and shifts of both signs. Later matrices of the
// same pattern may fail in the order in which the first ones did not.
TEST(SymmetricFactors, count_as_dense_eigenvalues_do) {
  std::mt19937 random(3);
  const auto uniform = [&] { return std::ldexp(static_cast<double>(random()), -32); };
  for (int draw = 0; draw < 200; ++draw) {
    const std::int32_t bodies = 2 + static_cast<std::int32_t>(random() % 12), n = 2 * bodies;
    const double spread = draw % 4 * 2.0;  // decades
    std::vector<Triplet> entries;
    std::int32_t row = n;
    for (std::int32_t k = 0; k < bodies; ++k) {
      for (const std::int32_t c : {2 * k, 2 * k + 1})
        entries.push_back({c, c, (uniform() - 0.4) * std::pow(10.0, spread * (uniform() - 0.5))});
      entries.push_back({2 * k + 1, 2 * k, 0.1 * uniform()});
      if (k == 0) continue;
      if (random() % 2 == 0) {
        for (std::int32_t c = 2 * k - 2; c < 2 * k + 2; ++c) entries.push_back({row, c, uniform() - 0.5});
        ++row;
      } else {
        entries.push_back({2 * k, 2 * k - 2, uniform()});
      }
    }
    const ColumnMatrix lower = compressed(row, row, entries);
    SymmetricFactors factors(lower);
    for (int shift = 0; shift < 3; ++shift) {
      ColumnMatrix now = lower;
      std::size_t k = 0;
      for_each_entry(lower, [&](std::int32_t r, std::int32_t c, double v) {
        now.value[k++] = r == c && r < n ? v + 0.5 * shift : v;
      });
      ASSERT_TRUE(factors.factor(now.value));
      EXPECT_EQ(factors.negative_pivots(), negative_values(dense(now))) << draw << " " << shift;
    }
  }
}

// Loops in all directions fill it in: MUMPS has the larger one.
TEST(SymmetricFactors, count_in_grids) {
  for (const std::int32_t side : {7, 13}) {
    const std::int32_t n = side * side * side, step[] = {1, side, side * side};
    std::vector<Triplet> entries;
    for (std::int32_t k = 0; k < n; ++k) {
      entries.push_back({k, k, 6.0 - 1.3});
      for (const std::int32_t s : step) {
        if (k / s % side > 0) entries.push_back({k, k - s, -1.0});
      }
    }
    const ColumnMatrix lower = compressed(n, n, entries);
    SymmetricFactors factors(lower);
    ASSERT_TRUE(factors.factor(lower.value));
    // 6 − 2 Σ cos(k π/(side + 1)) of three directions.
    const auto value = [&](int k) { return 2 - 2 * std::cos(k * std::acos(-1.0) / (side + 1)); };
    int below = 0;
    for (int i = 1; i <= side; ++i) {
      for (int j = 1; j <= side; ++j) {
        for (int k = 1; k <= side; ++k) below += value(i) + value(j) + value(k) < 1.3;
      }
    }
    EXPECT_GT(below, 3);
    EXPECT_EQ(factors.negative_pivots(), below) << side;
  }
}

}  // namespace
}  // namespace dynalin::symmetric_factors_test

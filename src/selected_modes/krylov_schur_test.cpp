#include "selected_modes/krylov_schur.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dynalin::krylov_schur_test {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

void expect_invariant(const KrylovSchur& space, const KrylovSchur::Operator& op, double limit) {
  for (Index k = 0; k < space.found(); ++k) {
    Eigen::VectorXcd v = space.basis().col(k);
    op(v);
    v -= space.basis() * space.triangle().col(k);
    EXPECT_LE(v.norm(), limit) << k;
  }
  const Eigen::MatrixXcd unit = space.basis().adjoint() * space.basis();
  EXPECT_LE((unit - Eigen::MatrixXcd::Identity(space.found(), space.found())).norm(), 1e-12);
}

TEST(KrylovSchur, finds_the_largest_values_of_a_matrix_that_is_not_normal) {
  constexpr Index n = 400;
  const auto op = [](Eigen::VectorXcd& x) {
    for (Index k = 0; k < n; ++k) {
      const Complex below = k + 1 < n ? x(k + 1) : 0;
      x(k) = std::polar(1.0 / static_cast<double>(k + 1), 0.3 * static_cast<double>(k)) * x(k) +
             0.05 / static_cast<double>(k + 1) * below;
    }
  };
  KrylovSchur space(n);
  ASSERT_TRUE(space.run(op, 6, 0));
  ASSERT_GE(space.found(), 6);
  for (Index k = 0; k < 4; ++k) {
    const Complex exact = std::polar(1.0 / static_cast<double>(k + 1), 0.3 * static_cast<double>(k));
    EXPECT_LE(std::abs(space.triangle()(k, k) - exact), 1e-8) << k;
  }
  expect_invariant(space, op, 1e-9);
}

// One start vector sees one direction of each multiple value.
TEST(KrylovSchur, finds_further_copies_from_further_start_vectors) {
  constexpr Index n = 300;
  const auto op = [](Eigen::VectorXcd& x) {
    for (Index k = 0; k < n; ++k) x(k) *= 1.0 / static_cast<double>(k / 3 + 1);
  };
  KrylovSchur space(n);
  const auto found_of = [&](double value) {
    Index count = 0;
    for (Index k = 0; k < space.found(); ++k) count += std::abs(space.triangle()(k, k) - value) < 1e-9;
    return count;
  };
  for (int round = 0; round < 4; ++round) ASSERT_TRUE(space.run(op, 4, 0.3));
  EXPECT_EQ(found_of(1), 3);
  EXPECT_EQ(found_of(0.5), 3);
  expect_invariant(space, op, 1e-9);
}

TEST(KrylovSchur, ends_with_everything) {
  constexpr Index n = 7;
  const auto op = [](Eigen::VectorXcd& x) {
    for (Index k = 0; k + 1 < n; ++k) x(k) = x(k) + x(k + 1);
  };
  KrylovSchur space(n);
  ASSERT_TRUE(space.run(op, 20, 0));
  EXPECT_TRUE(space.everything());
  expect_invariant(space, op, 1e-12);
}

}  // namespace
}  // namespace dynalin::krylov_schur_test

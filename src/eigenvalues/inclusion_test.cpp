#include "eigenvalues/inclusion.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>
#include <random>

namespace dynalin::inclusion_test {
namespace {

using Complex = std::complex<double>;
using Random = std::mt19937_64;

Eigen::MatrixXd normal_matrix(Random& random, Eigen::Index n) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
}

// Jordan blocks and single values in coordinates of their own.
Eigen::MatrixXd drawn(Random& random) {
  const Eigen::Index n = std::uniform_int_distribution<int>(1, 8)(random);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, n);
  double value = normal(random);
  for (Eigen::Index k = 0; k < n; ++k) {
    const bool same = k > 0 && std::uniform_int_distribution<int>(0, 1)(random) == 0;
    if (!same) value = normal(random);
    J(k, k) = value;
    if (same) J(k - 1, k) = 1;
  }
  const Eigen::MatrixXd P = normal_matrix(random, n);
  return std::uniform_int_distribution<int>(0, 2)(random) == 0 ? normal_matrix(random, n) : P * J * P.inverse();
}

// Every disc must hold its number of eigenvalues for any matrix within the uncertainty: here one that is large against
// the rounding of the eigenvalues that are counted.
TEST(Inclusion, discs_hold_their_number_of_eigenvalues_whatever_the_entries_within_their_uncertainty) {
  Random random(3);
  int examined = 0, narrow = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Eigen::MatrixXd M = drawn(random);
    const Eigen::Index n = M.rows();
    const double unit = std::pow(10.0, -2 - draw % 9);
    const Eigen::MatrixXd uncertainty = unit * normal_matrix(random, n).cwiseAbs();
    const auto discs = inclusion_discs(M.cast<std::complex<long double>>(), uncertainty, true);
    ASSERT_TRUE(discs);
    Eigen::Index total = 0;
    for (const InclusionDisc& d : *discs) total += d.centre.imag() > 0 ? 2 * d.count : d.count;
    ASSERT_EQ(total, n);
    for (int change = 0; change < 20; ++change) {
      Eigen::MatrixXd sign = normal_matrix(random, n);
      if (change % 2) sign = sign.cwiseSign();
      const Eigen::MatrixXd moved = M + uncertainty.cwiseProduct(sign.cwiseMax(-1).cwiseMin(1));
      const Eigen::VectorXcd values = moved.eigenvalues();
      for (const InclusionDisc& d : *discs) {
        // Of the values counted: 1e-15 to the power of one over their multiplicity, against 1e-10.
        const double slack = 1e-15 * M.norm() * std::pow(1e10, 1 - 1.0 / static_cast<double>(d.count));
        Eigen::Index inside = 0;
        for (const Complex& v : values) inside += std::abs(v - d.centre) <= d.radius * (1 + 1e-3) + slack;
        EXPECT_GE(inside, d.count) << "draw " << draw << " radius " << d.radius << " of " << d.count << "\n" << M;
        if (d.radius < 1e4 * unit) {
          EXPECT_EQ(inside, d.count) << "draw " << draw;
        }
        ++examined, narrow += d.radius < 0.1;
      }
    }
  }
  EXPECT_GT(narrow, examined / 3);
}

// A freedom that nothing holds, x′ = v and v′ = 0 but for rounding, uncertain far above it: its two values near zero
// are one direction, and what is known of the others does not suffer.
TEST(Inclusion, others_keep_their_radius_beside_two_values_that_are_rounding) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(6, 6);
  M(0, 1) = 1, M(1, 0) = 1e-30, M(1, 2) = 3e-14, M(2, 0) = 5e-16;
  M(2, 3) = 14, M(3, 2) = 16, M(4, 5) = 9, M(5, 4) = -8, M(2, 4) = 4, M(5, 2) = 3;
  Eigen::MatrixXd uncertainty = 1e-12 * Eigen::MatrixXd::Ones(6, 6);
  uncertainty.row(0).setZero(), uncertainty.row(3).setZero();
  const auto discs = inclusion_discs(M.cast<std::complex<long double>>(), uncertainty, true);
  ASSERT_TRUE(discs);
  Eigen::Index alone = 0;
  for (const InclusionDisc& d : *discs) {
    if (std::abs(d.centre) < 1) {
      EXPECT_EQ(d.count, 2);
      EXPECT_LT(d.radius, 1e-5);
      continue;
    }
    EXPECT_EQ(d.count, 1);
    EXPECT_LT(d.radius, 1e-10) << d.centre;
    ++alone;
  }
  EXPECT_GE(alone, 3);
}

// k eigenvalues within the k-th root of what is uncertain.
TEST(Inclusion, a_jordan_block_has_the_radius_of_its_order) {
  for (Eigen::Index k = 2; k <= 12; ++k) {
    Eigen::MatrixXd J = -Eigen::MatrixXd::Identity(k, k);
    J.diagonal(1).setOnes();
    Eigen::MatrixXd uncertainty = Eigen::MatrixXd::Zero(k, k);
    uncertainty(k - 1, 0) = 1e-12;
    const auto discs = inclusion_discs(J.cast<std::complex<long double>>(), uncertainty, true);
    ASSERT_TRUE(discs);
    ASSERT_EQ(discs->size(), 1u) << k;
    EXPECT_EQ((*discs)[0].count, k);
    EXPECT_LE(std::abs((*discs)[0].centre + 1.0), 1e-16);
    const double exact = std::pow(1e-12, 1.0 / static_cast<double>(k));
    EXPECT_GE((*discs)[0].radius, exact);
    EXPECT_LE((*discs)[0].radius, 5 * exact);
  }
}

TEST(Inclusion, well_separated_values_are_told_apart_to_long_double) {
  Random random(5);
  const Eigen::MatrixXd M = normal_matrix(random, 20);
  const auto discs = inclusion_discs(M.cast<std::complex<long double>>(), Eigen::MatrixXd::Zero(20, 20), true);
  ASSERT_TRUE(discs);
  Eigen::Index total = 0;
  for (const InclusionDisc& d : *discs) {
    EXPECT_EQ(d.count, 1);
    EXPECT_LT(d.radius, 1e-15);
    total += d.centre.imag() > 0 ? 2 : 1;
    EXPECT_LT((M * d.right.col(0) - d.centre * d.right.col(0)).norm(), 1e-13);
    EXPECT_LT((M.transpose() * d.left.col(0) - std::conj(d.centre) * d.left.col(0)).norm(), 1e-13);
  }
  EXPECT_EQ(total, 20);
}

// Equal oscillators that know nothing of each other, some of them a rounding off: they belong together, and not to the
// mirror image of the others.
TEST(Inclusion, equal_oscillators_share_a_disc_above_the_axis) {
  for (const Eigen::Index count : {2, 3, 6, 12}) {
    for (int kind = 0; kind < 3; ++kind) {
      const double off = 250 * (1 + 1.2e-16), plain = 250;
      LongComplexMatrix M = LongComplexMatrix::Zero(2 * count, 2 * count);
      Eigen::MatrixXd uncertainty = Eigen::MatrixXd::Zero(2 * count, 2 * count);
      for (Eigen::Index k = 0; k < count; ++k) {
        M(2 * k, 2 * k + 1) = kind == 0 || (kind == 1 && k % 2) ? -plain : -off;
        M(2 * k + 1, 2 * k) = 1;
        uncertainty(2 * k, 2 * k + 1) = 2.8e-14;
      }
      const auto discs = inclusion_discs(M, uncertainty, true);
      ASSERT_TRUE(discs);
      ASSERT_EQ(discs->size(), 1u) << count << " " << kind;
      EXPECT_EQ(discs->front().count, count);
      EXPECT_NEAR(std::abs(discs->front().centre - Complex(0, std::sqrt(250.0))), 0, 1e-14);
      EXPECT_LE(discs->front().radius, 1e-14);
    }
  }
}

// −b bᵀ with entries that are integers, so that all but one of its eigenvalues are 0, with as many vectors.
TEST(Inclusion, values_that_are_equal_without_a_defect_have_vectors_of_their_own) {
  Random random(11);
  std::uniform_int_distribution<int> entry(-4, 4);
  for (Eigen::Index n = 3; n <= 9; ++n) {
    for (int draw = 0; draw < 20; ++draw) {
      Eigen::VectorXd b(n);
      for (double& v : b) v = entry(random);
      if (b.isZero(0)) continue;
      const Eigen::MatrixXd A = -b * b.transpose();
      const auto discs = inclusion_discs(A.cast<std::complex<long double>>(), 1e-16 * A.cwiseAbs(), true);
      ASSERT_TRUE(discs);
      for (const InclusionDisc& disc : *discs) {
        const Eigen::Index vectors = disc.count == n - 1 ? n - 1 : 1;
        EXPECT_EQ(disc.count, vectors);
        for (const Eigen::MatrixXcd& side : {disc.right, disc.left})
          EXPECT_GT(side.jacobiSvd().singularValues().tail<1>()(0), 1e-3) << n << " " << draw;
        EXPECT_LT((A * disc.right - disc.right * disc.centre).norm(), 1e-13 * A.norm());
      }
    }
  }
}

// Three that differ by little more than they are known to: what tells them apart says nothing of their vectors, and
// each has its own, dual on both sides.
TEST(Inclusion, values_that_are_equal_but_for_a_few_roundings_have_vectors_of_their_own) {
  Random random(13);
  int together = 0;
  for (int draw = 0; draw < 100; ++draw) {
    const Eigen::Index n = 6;
    const double apart = 1e-14, unit = 1e-15 * (0.5 + 0.1 * (draw % 40));
    const Eigen::MatrixXd P = normal_matrix(random, n);
    Eigen::VectorXd values(n);
    values << 1 - apart, 1, 1 + apart, 3, -2, 7;
    const Eigen::MatrixXd Q = P.householderQr().householderQ();
    const Eigen::MatrixXd A = Q * values.asDiagonal() * Q.transpose();
    const auto discs = inclusion_discs(A.cast<std::complex<long double>>(), unit * Eigen::MatrixXd::Ones(n, n), true);
    ASSERT_TRUE(discs);
    for (const InclusionDisc& disc : *discs) {
      together += disc.count == 3;
      for (const Eigen::MatrixXcd& side : {disc.right, disc.left})
        EXPECT_GT(side.jacobiSvd().singularValues().tail<1>()(0), 0.1) << draw;
      const Eigen::MatrixXcd products = disc.left.adjoint() * disc.right;
      EXPECT_LT((products - Eigen::MatrixXcd(products.diagonal().asDiagonal())).norm(), 1e-6) << draw;
      EXPECT_LT((A * disc.right - disc.right * disc.centre).norm(), 1e-13 * A.norm());
    }
  }
  EXPECT_GT(together, 30);
}

}  // namespace
}  // namespace dynalin::inclusion_test

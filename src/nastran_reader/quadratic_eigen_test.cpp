// Finite eigenvalues of quadratic pencils that are made from known ones.
#include "nastran_reader/quadratic_eigen.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace dynalin::nastran_reader::quadratic_eigen_test {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Complex> values(const MatrixXd& M, const MatrixXd& B, const MatrixXd& K) {
  const auto found = finite_eigenvalues(M, B, K);
  EXPECT_TRUE(found.has_value()) << found.error();
  return found ? found->values : std::vector<Complex>{};
}

// Every expected value is there once, and nothing else.
void expect_values(std::vector<Complex> is, const std::vector<Complex>& should, double relative) {
  ASSERT_EQ(is.size(), should.size());
  for (const Complex& z : should) {
    const auto nearest = std::min_element(
        is.begin(), is.end(), [&](const Complex& a, const Complex& b) { return std::abs(a - z) < std::abs(b - z); });
    EXPECT_LE(std::abs(*nearest - z), relative * std::abs(z)) << "wanted " << z << " nearest " << *nearest;
    is.erase(nearest);
  }
}

void add_oscillator(MatrixXd& M, MatrixXd& B, MatrixXd& K, Index k, double m, double b, double stiffness,
                    std::vector<Complex>& out) {
  M(k, k) = m, B(k, k) = b, K(k, k) = stiffness;
  if (m != 0) {
    const Complex root = std::sqrt(Complex(b * b - 4 * m * stiffness));
    // Without cancellation: the larger one, and the other by the product.
    const Complex large = (b >= 0 ? -b - root : -b + root) / (2 * m);
    out.push_back(large);
    out.push_back(stiffness / m / large);
  } else if (b != 0) {
    out.push_back(-stiffness / b);
  }
}

// Oscillators, first order and algebraic parts, mixed by unsymmetric matrices on both sides.
TEST(QuadraticEigenvalues, of_mixed_orders) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 40; ++trial) {
    const Index n = 9;
    MatrixXd M = MatrixXd::Zero(n, n), B = M, K = M;
    std::vector<Complex> expected;
    for (Index k = 0; k < n; ++k) {
      const double s = std::exp(normal(random));
      add_oscillator(M, B, K, k, k < 4 ? s : 0, k < 7 ? .3 * std::exp(normal(random)) : 0,
                     20 * std::exp(normal(random)), expected);
    }
    MatrixXd left(n, n), right(n, n);
    for (MatrixXd* x : {&left, &right}) *x = x->unaryExpr([&](double) { return normal(random); });
    if (left.fullPivLu().rcond() < 1e-3 || right.fullPivLu().rcond() < 1e-3) continue;
    expect_values(values(left * M * right, left * B * right, left * K * right), expected, 1e-9);
    expect_values(values(M, B, K), expected, 1e-13);
  }
}

// Equations of a multiplier: an index of three, nothing but the motion along the constraint is left.
TEST(QuadraticEigenvalues, of_constraints_written_with_multipliers) {
  MatrixXd M = MatrixXd::Zero(3, 3), B = M, K = M;
  M(0, 0) = 2, M(1, 1) = 3;
  B(0, 0) = .4;
  K(0, 0) = 10, K(1, 1) = 20;
  K(0, 2) = K(2, 0) = 1, K(1, 2) = K(2, 1) = -1;  // u0 = u1
  std::vector<Complex> expected;
  MatrixXd m(1, 1), b(1, 1), k(1, 1);
  add_oscillator(m, b, k, 0, 5, .4, 30, expected);
  expect_values(values(M, B, K), expected, 1e-13);
}

TEST(QuadraticEigenvalues, are_exact_zeros_where_the_structure_has_them) {
  // Two masses on a spring, free in space.
  MatrixXd M(2, 2), K(2, 2), B = MatrixXd::Zero(2, 2);
  M << 3, 0, 0, 7;
  K << 1e5, -1e5, -1e5, 1e5;
  const auto found = finite_eigenvalues(M, B, K);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->zeros, 2);
  ASSERT_EQ(found->values.size(), 4u);
  EXPECT_EQ(found->values[0], Complex(0));
  EXPECT_EQ(found->values[1], Complex(0));
  EXPECT_NEAR(found->values[3].imag(), std::sqrt(1e5 * 10 / 21), 1e-10);
  // With a damper to ground one zero is left, and a slow motion.
  B(0, 0) = .1;
  const auto damped = finite_eigenvalues(M, B, K);
  ASSERT_TRUE(damped);
  EXPECT_EQ(damped->zeros, 1);
}

// Fourteen orders of stiffness, and masses to them.
TEST(QuadraticEigenvalues, of_badly_scaled_oscillators) {
  const Index n = 12;
  MatrixXd M = MatrixXd::Zero(n, n), B = M, K = M;
  std::vector<Complex> expected;
  for (Index k = 0; k < n; ++k) {
    const double m = std::pow(10.0, double(k) - 8), stiffness = std::pow(10.0, 9 - double(k) * .9);
    add_oscillator(M, B, K, k, m, .01 * std::sqrt(m * stiffness), stiffness, expected);
  }
  expect_values(values(M, B, K), expected, 1e-12);
}

// Masses and stiffnesses of twelve orders, coupled so that each motion has its own size in them: the numbers tell every
// one.
TEST(QuadraticEigenvalues, of_graded_matrices) {
  const Index n = 12;
  MatrixXd M = MatrixXd::Zero(n, n), B = M, K = M;
  std::vector<Complex> expected;
  for (Index k = 0; k < n; ++k) {
    const double m = std::pow(10.0, double(k) - 8),
                 stiffness = m * std::pow(10.0, 2 + .4 * double(k % 5) + .01 * double(k));
    add_oscillator(M, B, K, k, m, .01 * std::sqrt(m * stiffness), stiffness, expected);
  }
  MatrixXd T = MatrixXd::Identity(n, n);
  for (Index k = 1; k < n; ++k) T(k - 1, k) = 1;
  expect_values(values(T.transpose() * M * T, T.transpose() * B * T, T.transpose() * K * T), expected, 1e-12);
  const VectorXd back = VectorXd::LinSpaced(n, 0, 11).unaryExpr([](double k) { return std::pow(10.0, -2 * k); });
  expect_values(values(T.transpose() * M * T * back.asDiagonal(), T.transpose() * B * T * back.asDiagonal(),
                       T.transpose() * K * T * back.asDiagonal()),
                expected, 1e-12);
}

// A stiff joint and a pendulum: slow by 1e7 and as exact as the numbers given.
TEST(QuadraticEigenvalues, of_slow_motions_beside_stiff_ones) {
  const double stiff = 1e12, soft = 3;
  MatrixXd M(2, 2), K(2, 2);
  M << 2, 1, 1, 5;
  K << stiff, 0, 0, soft;
  // λ² = −w²: w² are the roots of 9 x² − (2 soft + 5 stiff) x + stiff soft.
  const double sum = (2 * soft + 5 * stiff) / 9, product = stiff * soft / 9;
  const double fast = (sum + std::sqrt(sum * sum - 4 * product)) / 2, slow = product / fast;
  const std::vector<Complex> found = values(M, MatrixXd::Zero(2, 2), K);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_NEAR(found[1].imag() / std::sqrt(slow), 1, 1e-13);
  EXPECT_NEAR(found[3].imag() / std::sqrt(fast), 1, 1e-13);
}

// A mass that is small is a mass.
TEST(QuadraticEigenvalues, tells_a_small_mass_from_none) {
  for (const double small : {1e-8, 1e-12, 1e-20}) {
    MatrixXd M(2, 2), K(2, 2);
    M << 1, 0, 0, small;
    K << 3, -1, -1, 1e6;
    const std::vector<Complex> found = values(M, MatrixXd::Zero(2, 2), K);
    ASSERT_EQ(found.size(), 4u) << small;
    EXPECT_NEAR(found[3].imag() / std::sqrt(1e6 / small), 1, 1e-6);
    EXPECT_NEAR(found[1].imag() / std::sqrt(3 - 1e-6), 1, 1e-7);
  }
}

// Rounding where a zero was meant, in the row of a state: scaled by itself it looks like any other row.
TEST(QuadraticEigenvalues, keeps_the_large_one_of_rows_that_say_the_same) {
  for (const double rounding : {-4e-20, 1e-18, 1e-30}) {
    MatrixXd M(2, 2), B(2, 2), K(2, 2);
    M << 11, 0, rounding, 0;
    B << 1.2, 0, 4e-5, 1;
    K << 67, 0, -3e-3, 0.48;
    const std::vector<Complex> found = values(M, B, K);
    ASSERT_EQ(found.size(), 3u) << rounding;
    EXPECT_NEAR(found[0].real(), -0.48, 1e-14);
    const double damping = 1.2 / 22;
    EXPECT_NEAR(found[2].real(), -damping, 1e-14);
    EXPECT_NEAR(found[2].imag(), std::sqrt(67.0 / 11 - damping * damping), 1e-13);
  }
}

TEST(QuadraticEigenvalues, refuses_what_nothing_determines) {
  MatrixXd M = MatrixXd::Zero(2, 2), K = M;
  M(0, 0) = 1, K(0, 0) = 1;
  EXPECT_FALSE(finite_eigenvalues(M, K * 0, K));
  K << 1, 1, 1, 1;
  EXPECT_FALSE(finite_eigenvalues(K, K * 0, K));
  K(0, 0) = HUGE_VAL;
  EXPECT_FALSE(finite_eigenvalues(M, M, K));
}

}  // namespace
}  // namespace dynalin::nastran_reader::quadratic_eigen_test

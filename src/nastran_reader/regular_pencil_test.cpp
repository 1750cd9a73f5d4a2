#include "nastran_reader/regular_pencil.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "nastran_reader/quadratic_eigen.h"

namespace dynalin::nastran_reader::regular_pencil_test {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;

// Two masses, one held by a stiff spring and one by a soft one, damped: the slow pair is that of a condensed
// oscillator.
Pencil stiff_and_soft(double stiff) {
  MatrixXd M(2, 2), B(2, 2), K(2, 2);
  M << 2, 1, 1, 5;
  B << .1, 0, 0, .2;
  K << stiff, 0, 0, 3;
  Pencil p{MatrixXd::Identity(4, 4), MatrixXd::Zero(4, 4)};
  p.E.topLeftCorner(2, 2) = M;
  p.A << -B, -K, MatrixXd::Identity(2, 2), MatrixXd::Zero(2, 2);
  return p;
}

Complex slowest(const std::vector<Complex>& all) {
  const auto z =
      std::min_element(all.begin(), all.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  return {z->real(), std::abs(z->imag())};
}

TEST(RegularPencil, correction_by_vectors_keeps_slow_values_exact) {
  const double stiff = 1e14;
  // The characteristic polynomial at the slow pair: λ² terms of the stiff row are condensed to first order in 1/stiff.
  Complex z(-.02, std::sqrt(3.0 / 5));
  for (int k = 0; k < 50; ++k) {
    const auto det = [&](std::complex<long double> s) {
      const std::complex<long double> a = 2.0L * s * s + .1L * s + static_cast<long double>(stiff),
                                      d = 5.0L * s * s + .2L * s + 3.0L;
      return d - s * s * s * s / a;
    };
    const std::complex<long double> s(z), h(1e-6L, 0);
    z = Complex(s - det(s) / ((det(s + h) - det(s - h)) / (2.0L * h)));
  }
  const auto corrected = regular_eigenvalues(stiff_and_soft(stiff), Correction::by_vectors);
  ASSERT_TRUE(corrected);
  EXPECT_LT(std::abs(slowest(*corrected) - z), 1e-14);
  EXPECT_EQ(std::count_if(corrected->begin(), corrected->end(), [](Complex v) { return v.imag() > 0; }), 2);
}

// Slow and stiff springs in turn, in relative coordinates: values refined one by one, which costs a factorization each,
// and corrected together are the same, though the QR iteration has lost seven digits of the slow ones.
TEST(RegularPencil, correction_and_refinement_agree_on_slow_values) {
  const Eigen::Index n = 12;
  MatrixXd T = MatrixXd::Zero(n, n), K = T;
  for (Eigen::Index k = 0; k < n; ++k) {
    T.row(k).head(k + 1).setOnes();
    K(k, k) = k % 2 ? 1e9 * (1 + .1 * double(k)) : 2 + .3 * double(k);
  }
  const MatrixXd M = T.transpose() * T;
  Pencil p{MatrixXd::Identity(2 * n, 2 * n), MatrixXd::Zero(2 * n, 2 * n)};
  p.E.topLeftCorner(n, n) = M;
  p.A.topRightCorner(n, n) = -K;
  p.A.bottomLeftCorner(n, n).setIdentity();
  const auto refined = finite_eigenvalues(M, MatrixXd::Zero(n, n), K);
  const auto corrected = regular_eigenvalues(p, Correction::by_vectors);
  ASSERT_TRUE(refined && corrected);
  for (const Complex& z : refined->values) {
    double nearest = HUGE_VAL;
    for (const Complex& c : *corrected) nearest = std::min(nearest, std::abs(c - z));
    EXPECT_LT(nearest, 1e-13 * std::abs(z)) << z;
  }
}

TEST(RegularPencil, correction_takes_nothing_from_real_values) {
  Pencil p{MatrixXd::Identity(3, 3), MatrixXd::Zero(3, 3)};
  p.A << -1, 1e6, 3, 0, -2, 1e6, 0, 0, -3;
  const auto values = regular_eigenvalues(p, Correction::by_vectors);
  ASSERT_TRUE(values);
  std::vector<double> real;
  for (const Complex& v : *values) real.push_back(v.real());
  std::sort(real.begin(), real.end());
  EXPECT_NEAR(real[0], -3, 1e-9);
  EXPECT_NEAR(real[1], -2, 1e-9);
  EXPECT_NEAR(real[2], -1, 1e-9);
}

// A pencil that is regular and far from any standard problem.
TEST(RegularPencil, with_ill_conditioned_masses_goes_by_qz) {
  Pencil p{MatrixXd(2, 2), MatrixXd::Identity(2, 2)};
  p.E << 1, 1, 1, 1 + 1e-11;
  const auto values = regular_eigenvalues(p, Correction::none);
  ASSERT_TRUE(values);
  EXPECT_NEAR(slowest(*values).real(), .5, 1e-9);
}

}  // namespace
}  // namespace dynalin::nastran_reader::regular_pencil_test

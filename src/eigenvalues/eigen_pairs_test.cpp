#include "eigenvalues/eigen_pairs.h"

#include <gtest/gtest.h>

namespace dynalin::eigen_pairs_test {
namespace {

// A chain of five zeros, at whose end a value of 1e-90: the vector is [1/λ⁵ … 1/λ 1] in its direction, and 1/λ⁵ no
// number.
TEST(eigen_pairs, vectors_of_tiny_values_beside_long_chains_of_zeros_are_numbers) {
  constexpr Eigen::Index chain = 5, n = chain + 1;
  constexpr double value = 1e-90;
  ZeroModes zero;
  zero.count = chain;
  zero.block = Eigen::MatrixXd::Zero(n, n);
  zero.block.diagonal(1).setOnes();
  zero.block(chain, chain) = value;
  zero.scale = Eigen::VectorXd::Ones(n);
  zero.basis = zero.dual = Eigen::MatrixXd::Identity(n, n);
  EigenPairs pairs;
  pairs.values = {value};
  pairs.right = pairs.left = Eigen::MatrixXcd::Ones(1, 1);
  map_to_states(zero, pairs);
  ASSERT_TRUE(pairs.right.allFinite());
  EXPECT_NEAR(std::abs(pairs.right(0, 0)), 1, 1e-15);
  EXPECT_NEAR(std::abs(pairs.right(1, 0)) / value, 1, 1e-15);
  EXPECT_EQ(pairs.left(chain, 0), 1.0);
}

// Of [0 0; 0 0] beside a rate of one, computed as a pair: vectors (1 ± j), (2 ± j).
EigenPairs pair_next_to_zero(double modulus) {
  using Complex = std::complex<double>;
  EigenPairs pairs;
  pairs.values = {1.0, Complex(-0.6 * modulus, 0.8 * modulus)};
  pairs.right = pairs.left = Eigen::MatrixXcd::Zero(3, 2);
  pairs.right(0, 0) = pairs.left(0, 0) = 1;
  pairs.right.col(1) << 0, Complex(1, 1), Complex(2, -1);
  pairs.left.col(1) << 0, Complex(1, 2), Complex(1, -1);
  pairs.right.col(1).normalize(), pairs.left.col(1).normalize();
  return pairs;
}

// The same at −1, off the axis by rounding.
TEST(eigen_pairs, equal_real_values_computed_as_a_pair_become_real) {
  EigenPairs pairs = pair_next_to_zero(1);
  pairs.values[1] = {-1, 1e-15};
  EigenPairs apart = pairs;
  apart.values[1] = {-1, 1e-6};
  split_pairs_of_equal_values(pairs), split_pairs_of_equal_values(apart);
  ASSERT_EQ(pairs.values.size(), 3u);
  EXPECT_EQ(apart.values.size(), 2u);
  for (const Eigen::Index k : {1, 2}) {
    EXPECT_EQ(pairs.values[static_cast<std::size_t>(k)], -1.0);
    EXPECT_EQ(pairs.right.col(k).imag().norm() + pairs.left.col(k).imag().norm(), 0);
    EXPECT_NEAR(std::abs(pairs.left.col(3 - k).dot(pairs.right.col(k))), 0, 1e-15);
  }
}

// A chain of two has one vector: what is next to parallel stays a pair.
TEST(eigen_pairs, a_defective_pair_stays_one) {
  EigenPairs pairs = pair_next_to_zero(1);
  pairs.values[1] = {-1, 1e-15};
  pairs.right.col(1) << 0, std::complex<double>(1, 1e-8), std::complex<double>(0, 1e-9);
  pairs.left.col(1) << 0, std::complex<double>(0, 1e-9), std::complex<double>(1, 1e-8);
  split_pairs_of_equal_values(pairs);
  EXPECT_EQ(pairs.values.size(), 2u);
}

// A factor of any phase is no part of the vector of a real value.
TEST(eigen_pairs, vectors_of_single_real_values_are_real) {
  EigenPairs pairs = pair_next_to_zero(1);
  pairs.right.col(0) << std::polar(0.8, 1.0), std::polar(-0.6, 1.0), 0;
  const Eigen::VectorXcd complex = pairs.right.col(1);
  clear_phases(pairs, std::vector<EigenTrust>(2, {1e-15, 0, true, 1}));
  EXPECT_EQ(pairs.right.col(0).imag().norm(), 0);
  EXPECT_NEAR(pairs.right(0, 0).real(), 0.8, 1e-15);
  EXPECT_NEAR(pairs.right(1, 0).real(), -0.6, 1e-15);
  EXPECT_EQ(pairs.right.col(1), complex);
}

// To first order a bound is as large as the value that is computed for a zero, and rounding makes it a hair less.
TEST(eigen_pairs, a_value_as_large_as_its_bound_is_zero) {
  for (const double off : {-1.2e-65, 2.5e-17, -2.5e-17}) {
    EigenPairs pairs = pair_next_to_zero(1);
    pairs.values[0] = 30, pairs.values[1] = off;
    std::vector<EigenTrust> trust(2, {0.98 * std::abs(off), 0, true, 1});
    clear_rounding(pairs, trust);
    EXPECT_EQ(pairs.values[1], 0.0);
    EXPECT_GE(trust[1].bound, std::abs(off));
    pairs.values[1] = off, trust[1].bound = 0.4 * std::abs(off);
    clear_rounding(pairs, trust);
    EXPECT_EQ(pairs.values[1], off);
  }
}

TEST(eigen_pairs, a_pair_next_to_zero_is_two_zeros) {
  EigenPairs pairs = pair_next_to_zero(1e-33);
  std::vector<EigenTrust> trust(2, {1e-15, 0, true, 1});
  split_pairs_of_zeros(pairs, trust);
  ASSERT_EQ(pairs.values.size(), 3u);
  ASSERT_EQ(trust.size(), 3u);
  EXPECT_EQ(pairs.values[0], 1.0);
  for (const Eigen::Index k : {1, 2}) {
    EXPECT_EQ(pairs.values[static_cast<std::size_t>(k)], 0.0);
    EXPECT_GE(trust[static_cast<std::size_t>(k)].bound, 1e-15);
    EXPECT_EQ(pairs.right.col(k).imag().norm() + pairs.left.col(k).imag().norm(), 0);
    EXPECT_NEAR(pairs.right.col(k).norm(), 1, 1e-15);
    EXPECT_NEAR(pairs.left.col(k).norm(), 1, 1e-15);
    EXPECT_GT(std::abs(pairs.left.col(k).dot(pairs.right.col(k))), 0.1);
    EXPECT_NEAR(std::abs(pairs.left.col(3 - k).dot(pairs.right.col(k))), 0, 1e-15);
  }
}

// What is small but refined to digits of its own stays, and what its bound does not reach.
TEST(eigen_pairs, slow_pairs_stay_pairs) {
  EigenPairs slow = pair_next_to_zero(1e-30), certain = pair_next_to_zero(1e-33);
  std::vector<EigenTrust> wide(2, {1e-15, 0, true, 1}), narrow(2, {1e-34, 0, true, 1});
  split_pairs_of_zeros(slow, wide);
  split_pairs_of_zeros(certain, narrow);
  EXPECT_EQ(slow.values.size(), 2u);
  EXPECT_EQ(certain.values.size(), 2u);
}

// Reals before pairs, by size, then the negative one; what differs by rounding alone keeps its order.
TEST(eigen_pairs, are_listed_in_one_order_however_they_were_found) {
  using Complex = std::complex<double>;
  const std::vector<Complex> values = {
      {0.3, 2}, {2, 0}, {-0.3, 2 * (1 + 1e-14)}, {-2 * (1 + 1e-15), 0}, {-1, 0}, {1e-17, 1}, {-1e-17, 1}, {5, 1}};
  const std::vector<std::size_t> expected = {4, 3, 1, 5, 6, 7, 2, 0};
  EXPECT_EQ(printed_order(values), expected);
  std::vector<Complex> back(values.rbegin(), values.rend());
  std::vector<std::size_t> found = printed_order(back);
  for (std::size_t& k : found) k = values.size() - 1 - k;
  std::swap(found[3], found[4]);  // of rounding
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace dynalin::eigen_pairs_test

#include "linear/eigen_pairs.h"

#include <gtest/gtest.h>

namespace dynalin {
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

}  // namespace
}  // namespace dynalin

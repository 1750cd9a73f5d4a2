// Rank and null vectors of small matrices with roundings of known sizes.
#include "analysis/rank_split.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace dynalin::rank_split_test {
namespace {

Eigen::MatrixXd drawn(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  std::uniform_real_distribution<double> number(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return number(random); });
}

TEST(RankSplit, null_vectors_of_products_of_thin_matrices_vanish_but_for_rounding) {
  std::mt19937 random(3);
  for (int n = 0; n < 60; ++n) {
    const Eigen::Index size = 1 + n % 7, rank = n % (size + 1);
    const Eigen::MatrixXd A = drawn(random, size, rank), B = drawn(random, rank, size);
    Eigen::MatrixXd M = A * B, sizes = A.cwiseAbs() * B.cwiseAbs();
    for (Eigen::Index r = 0; r < size; ++r) {  // rows in units of their own
      const double unit = std::ldexp(1.0, static_cast<int>(9 * r) - 20);
      M.row(r) *= unit, sizes.row(r) *= unit;
    }
    const RankSplit s = rank_split(M, sizes);
    ASSERT_EQ(static_cast<Eigen::Index>(s.pivot_row.size()), rank);
    ASSERT_EQ(s.right_null.cols(), size - rank);
    ASSERT_EQ(s.left_null.cols(), size - rank);
    const Eigen::MatrixXd right = M * s.right_null, left = s.left_null.transpose() * M;
    for (Eigen::Index r = 0; r < size && rank < size; ++r)
      EXPECT_LE(right.row(r).cwiseAbs().maxCoeff(), 1e-9 * M.row(r).cwiseAbs().maxCoeff());
    const Eigen::MatrixXd terms = s.left_null.cwiseAbs().transpose() * M.cwiseAbs();
    for (Eigen::Index c = 0; c < size; ++c) {
      for (Eigen::Index k = 0; k < size - rank; ++k) EXPECT_LE(std::abs(left(k, c)), 1e-9 * terms(k, c));
    }
    for (Eigen::Index k = 0; k < size - rank; ++k) {
      for (Eigen::Index j = 0; j < size - rank; ++j) {
        const auto at = static_cast<std::size_t>(j);
        EXPECT_EQ(s.right_null(s.other_column[at], k), j == k ? 1 : 0);
        EXPECT_EQ(s.left_null(s.other_row[at], k), j == k ? 1 : 0);
      }
    }
  }
}

TEST(RankSplit, pivots_are_places_of_a_regular_block) {
  const Eigen::MatrixXd M{{0, 0, 3}, {0, 0, 0}, {2, 0, 1}};
  const RankSplit s = rank_split(M, M.cwiseAbs());
  ASSERT_EQ(s.pivot_row.size(), 2u);
  EXPECT_EQ(s.other_row, std::vector<Eigen::Index>{1});
  EXPECT_EQ(s.other_column, std::vector<Eigen::Index>{1});
  EXPECT_NE(M(s.pivot_row, s.pivot_column).determinant(), 0);
}

TEST(RankSplit, what_is_left_of_larger_terms_is_zero_and_a_small_entry_of_small_terms_is_not) {
  const Eigen::MatrixXd M{{1e-14}};
  EXPECT_EQ(rank_split(M, Eigen::MatrixXd{{10.0}}).pivot_row.size(), 0u);
  EXPECT_EQ(rank_split(M, Eigen::MatrixXd{{1e-14}}).pivot_row.size(), 1u);
  EXPECT_EQ(rank_split(M, Eigen::MatrixXd{{0.1}}).pivot_row.size(), 1u);
  // Cancellation while eliminating counts as well: 1 − 3 · (1/3)
  const Eigen::MatrixXd N{{3, 1}, {1, 1.0 / 3}};
  EXPECT_EQ(rank_split(N, N).pivot_row.size(), 1u);
}

TEST(RankSplit, of_nothing_is_nothing) {
  const RankSplit s = rank_split(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 0));
  EXPECT_TRUE(s.pivot_row.empty());
  EXPECT_EQ(s.right_null.size(), 0);
}

}  // namespace
}  // namespace dynalin::rank_split_test

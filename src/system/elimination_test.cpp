// Rank and pivots of rows of constraints, against dense linear algebra and rows whose dependence is known.
#include "system/elimination.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace dynalin::elimination_test {
namespace {

using ::testing::ElementsAre;

std::vector<SparseRow> sparse(const Eigen::MatrixXd& m) {
  std::vector<SparseRow> rows(static_cast<std::size_t>(m.rows()));
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    for (Eigen::Index c = m.cols(); c-- > 0;) {  // any order of columns
      if (m(r, c) == 0) continue;
      rows[static_cast<std::size_t>(r)].column.push_back(static_cast<std::int32_t>(c));
      rows[static_cast<std::size_t>(r)].value.push_back(m(r, c));
    }
  }
  return rows;
}
Elimination eliminated(const Eigen::MatrixXd& m, const std::vector<std::int32_t>& order,
                       const EliminationOptions& options = {}) {
  return eliminate(sparse(m), static_cast<std::int32_t>(m.cols()), order, options);
}
std::vector<std::int32_t> in_order(std::int32_t n) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

// A sparse matrix of m rows of which only `rank` are independent: the others are sums of some of these.
Eigen::MatrixXd drawn(std::mt19937& random, Eigen::Index m, Eigen::Index n, Eigen::Index rank) {
  std::uniform_real_distribution<double> number(-1, 1), chance(0, 1);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(m, n);
  for (Eigen::Index r = 0; r < rank; ++r) {
    a(r, r) = 1 + chance(random);
    for (Eigen::Index c = 0; c < n; ++c) {
      if (chance(random) < 0.2) a(r, c) += number(random);
    }
  }
  for (Eigen::Index r = rank; r < m; ++r) {
    for (Eigen::Index k = 0; k < rank; ++k) {
      if (chance(random) < 0.3) a.row(r) += number(random) * a.row(k);
    }
  }
  Eigen::PermutationMatrix<Eigen::Dynamic> shuffled(m), columns(n);
  shuffled.setIdentity(), columns.setIdentity();
  std::shuffle(shuffled.indices().data(), shuffled.indices().data() + m, random);
  std::shuffle(columns.indices().data(), columns.indices().data() + n, random);
  return shuffled * a * columns;
}

Eigen::MatrixXd picked(const Eigen::MatrixXd& m, const Elimination& e) {
  std::vector<Eigen::Index> rows, columns;
  for (std::size_t r = 0; r < e.pivot_column.size(); ++r) {
    if (e.pivot_column[r] >= 0) rows.push_back(static_cast<Eigen::Index>(r)), columns.push_back(e.pivot_column[r]);
  }
  return m(rows, columns);
}

TEST(Elimination, finds_the_rank_and_a_regular_block_of_rows_and_columns) {
  std::mt19937 random(4);
  for (int n = 0; n < 100; ++n) {
    const Eigen::Index rank = 1 + n % 9, columns = rank + n % 5, rows = rank + n % 4;
    const Eigen::MatrixXd m = drawn(random, rows, columns, rank);
    std::vector<std::int32_t> order = in_order(static_cast<std::int32_t>(columns));
    std::shuffle(order.begin(), order.end(), random);
    const Elimination e = eliminated(m, order);
    Eigen::FullPivLU<Eigen::MatrixXd> lu(m);
    const Eigen::Index expected = lu.setThreshold(1e-11).rank();
    ASSERT_EQ(static_cast<Eigen::Index>(e.rank), expected);
    const Eigen::MatrixXd block = picked(m, e);
    ASSERT_EQ(block.rows(), expected);
    EXPECT_GT(std::abs(block.fullPivLu().determinant()), 1e-12);
    EXPECT_EQ(std::count(e.dependent.begin(), e.dependent.end(), true), expected);
    for (const std::int32_t c : e.pivot_column) EXPECT_TRUE(c < 0 || e.dependent[static_cast<std::size_t>(c)]);
  }
}

TEST(Elimination, what_stands_late_in_the_order_stays_independent) {
  const Eigen::MatrixXd m{{1, 1, 0}, {0, 1, 1}};
  EXPECT_THAT(eliminated(m, {0, 1, 2}).dependent, ElementsAre(true, true, false));
  EXPECT_THAT(eliminated(m, {2, 1, 0}).dependent, ElementsAre(false, true, true));
  EXPECT_THAT(eliminated(m, {2, 0, 1}).dependent, ElementsAre(true, false, true));
}

TEST(Elimination, a_small_entry_is_no_pivot_while_the_row_has_a_large_one) {
  const Eigen::MatrixXd m{{0.05, 1, 0}};
  EXPECT_THAT(eliminated(m, {0, 1, 2}).dependent, ElementsAre(false, true, false));
  EXPECT_THAT(eliminated(m, {0, 1, 2}, {.pivot_threshold = 0.01}).dependent, ElementsAre(true, false, false));
}

TEST(Elimination, columns_passed_over_are_offered_again_when_nothing_else_is_left) {
  // In the first row the first column is too small; the second takes the only large column.
  const Eigen::MatrixXd m{{0.05, 1}, {0, 1}};
  const Elimination e = eliminated(m, {0, 1});
  EXPECT_EQ(e.rank, 2u);
  EXPECT_THAT(e.dependent, ElementsAre(true, true));
}

TEST(Elimination, of_rows_that_fit_the_one_that_ends_soonest_in_the_order_goes_first) {
  const Eigen::MatrixXd m{{1, 0, 0, 1}, {1, 1, 1, 0}, {1, 0, 1, 0}};
  const Elimination e = eliminated(m, {0, 1, 2, 3});
  EXPECT_EQ(e.pivot_column[2], 0);  // ends as soon as the row before it, and is sparser
}

TEST(Elimination, rows_that_follow_from_others_are_redundant_and_no_other_row_is) {
  const Eigen::MatrixXd m{{1, 2, 0, 0}, {0, 1, 3, 0}, {2, 5, 3, 0}, {0, 0, 0, 1}};
  for (const auto& order : {std::vector<std::int32_t>{0, 1, 2, 3}, {3, 2, 1, 0}, {1, 0, 3, 2}}) {
    const Elimination e = eliminated(m, order);
    EXPECT_EQ(e.rank, 3u);
    EXPECT_GE(e.pivot_column[3], 0);
    EXPECT_EQ(std::count(e.pivot_column.begin(), e.pivot_column.begin() + 3, -1), 1);
  }
}

TEST(Elimination, empty_rows_and_rows_of_zeros_are_redundant) {
  std::vector<SparseRow> rows(3);
  rows[1] = {{0, 1}, {0.0, 0.0}};
  rows[2] = {{1}, {-4}};
  const Elimination e = eliminate(rows, 2, in_order(2));
  EXPECT_THAT(e.pivot_column, ElementsAre(-1, -1, 1));
  EXPECT_THAT(e.dependent, ElementsAre(false, true));
}

TEST(Elimination, the_units_of_a_row_change_nothing) {
  std::mt19937 random(9);
  for (int n = 0; n < 30; ++n) {
    const Eigen::MatrixXd m = drawn(random, 9, 11, 6);
    Eigen::MatrixXd scaled = m;
    for (Eigen::Index r = 0; r < m.rows(); ++r) scaled.row(r) *= std::ldexp(1.0, static_cast<int>(7 * r) - 30);
    const Elimination a = eliminated(m, in_order(11)), b = eliminated(scaled, in_order(11));
    EXPECT_EQ(a.pivot_column, b.pivot_column);
    EXPECT_EQ(a.dependent, b.dependent);
  }
}

// What a redundant row is away from the others tells whether a smaller tolerance would keep it.
TEST(Elimination, says_how_far_redundant_rows_are_from_depending_on_others) {
  EXPECT_EQ(eliminated(Eigen::MatrixXd{{1, 0}, {0, 1}}, {0, 1}).largest_dropped, 0);
  const Eigen::MatrixXd m{{1, 2, 0}, {2, 4, 6e-11}, {3, 6, 6e-13}};
  const Elimination e = eliminated(m, {0, 1, 2});
  EXPECT_EQ(e.rank, 1u);
  EXPECT_NEAR(e.largest_dropped, 1.5e-11, 1e-15);
  EXPECT_EQ(eliminated(m, {0, 1, 2}, {.rank_tolerance = 1e-11}).rank, 2u);
}

TEST(Elimination, rounding_is_no_rank_and_a_small_difference_is) {
  Eigen::MatrixXd m{{1.0 / 3, 1, 0}, {2.0 / 3, 2, 1e-15}, {1, 3, 1e-6}};
  EXPECT_EQ(eliminated(m, {0, 1, 2}).rank, 2u);
  m(2, 2) = 0;
  EXPECT_EQ(eliminated(m, {0, 1, 2}).rank, 1u);
  m(2, 2) = 1e-8;
  EXPECT_EQ(eliminated(m, {0, 1, 2}, {.rank_tolerance = 1e-7}).rank, 1u);
}

}  // namespace
}  // namespace dynalin::elimination_test

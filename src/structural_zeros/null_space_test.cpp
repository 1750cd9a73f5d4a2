#include "structural_zeros/null_space.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>

namespace dynalin::null_space_test {
namespace {

using Rows = std::vector<Eigen::RowVectorXd>;

TEST(NullSpace, spans_what_no_row_sees) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (Eigen::Index columns = 1; columns <= 9; ++columns) {
    for (Eigen::Index rank = 0; rank <= columns; ++rank) {
      const Eigen::MatrixXd seen = Eigen::MatrixXd::NullaryExpr(rank, columns, [&] { return normal(random); });
      Rows rows;
      for (int k = 0; k < 30 && rank > 0; ++k)
        rows.emplace_back(Eigen::RowVectorXd::NullaryExpr(rank, [&] { return normal(random); }) * seen);
      const Eigen::MatrixXd null = null_space(rows, columns, 1e-12);
      ASSERT_EQ(null.rows(), columns);
      ASSERT_EQ(null.cols(), columns - rank);
      for (const auto& row : rows) EXPECT_LE((row * null).norm(), 1e-12);
      if (null.cols() > 0) {
        EXPECT_EQ(null.fullPivLu().rank(), null.cols());
      }
    }
  }
}

// The largest entries of both columns stand in two rows that depend on each other; a small third one tells.
TEST(NullSpace, looks_at_small_rows_where_the_large_ones_do_not_decide) {
  Rows rows(3, Eigen::RowVectorXd::Zero(2));
  rows[0] << 1, 1, rows[1] << 2, 2, rows[2] << 1e-9, 0;
  EXPECT_EQ(null_space(rows, 2, 1e-13).cols(), 0);
  EXPECT_EQ(null_space(rows, 2, 1e-8).cols(), 1);
  rows[2](1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(null_space(rows, 2, 1e-8).cols(), 0);
}

// Turned, so that no entry is zero.
Eigen::Index independent(double apart) {
  Eigen::MatrixXd columns(4, 3);
  columns << 1, 0.6, 0.8, 0, 0.8, -0.6, 0, 0, apart, 0, 0, 0;
  columns.col(2).normalize();
  const Eigen::Vector4d normal = Eigen::Vector4d(1, 2, -3, 1).normalized();
  columns -= 2 * normal * (normal.transpose() * columns).eval();
  return independent_columns(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(columns));
}

TEST(IndependentColumns, tells_directions_apart_that_differ_by_more_than_they_are_known_to) {
  EXPECT_EQ(independent(1), 3);
  EXPECT_EQ(independent(1e-5), 3);
  EXPECT_EQ(independent(1e-7), 2);
  EXPECT_EQ(independent(0), 2);
}

}  // namespace
}  // namespace dynalin::null_space_test

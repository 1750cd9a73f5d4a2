#include "nastran_reader/elimination.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace dynalin::nastran_reader::elimination_test {
namespace {

using Eigen::MatrixXd;

Equations equations(const MatrixXd& rows) {
  Equations e;
  e.fixed.assign(static_cast<std::size_t>(rows.cols()), false);
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    ConstraintRow row;
    for (Eigen::Index c = 0; c < rows.cols(); ++c) {
      if (rows(r, c) != 0) row.terms.emplace_back(static_cast<int>(c), rows(r, c));
    }
    e.rows.push_back(row);
  }
  return e;
}

MatrixXd random_rows(int rows, int columns, std::mt19937& random) {
  std::uniform_real_distribution<double> value(-1, 1);
  std::uniform_int_distribution<int> at(0, columns - 1);
  MatrixXd m = MatrixXd::Zero(rows, columns);
  for (int r = 0; r < rows; ++r) {
    for (int k = 0; k < 4; ++k) m(r, at(random)) = value(random);
  }
  return m;
}

// T spans all that meets the rows, and independent freedoms are themselves.
void expect_null_space(const MatrixXd& rows, const Elimination& e) {
  const MatrixXd T(e.T);
  EXPECT_LT((rows * T).cwiseAbs().maxCoeff(), 1e-11 * std::max(1.0, T.cwiseAbs().maxCoeff()));
  const Eigen::Index rank = Eigen::FullPivLU<MatrixXd>(rows).setThreshold(1e-10).rank();
  EXPECT_EQ(T.cols(), rows.cols() - rank);
  EXPECT_EQ(static_cast<Eigen::Index>(e.redundant.size()), rows.rows() - rank);
  EXPECT_TRUE(T(e.independent, Eigen::all).isIdentity(0));
}

TEST(Elimination, of_random_rows) {
  std::mt19937 random(3);
  for (int k = 0; k < 50; ++k) {
    const MatrixXd m = random_rows(12 + k % 5, 30, random);
    const Elimination e = eliminate(equations(m));
    expect_null_space(m, e);
    EXPECT_TRUE(e.nearly_redundant.empty());
  }
}

// Sums of rows are redundant, in whatever order and units they come.
TEST(Elimination, recognizes_redundant_rows_in_any_units) {
  std::mt19937 random(5);
  for (int k = 0; k < 50; ++k) {
    MatrixXd m(16, 30);
    m.topRows(12) = random_rows(12, 30, random);
    m.bottomRows(4) = MatrixXd::Random(4, 12) * m.topRows(12);
    const MatrixXd in_order = m;
    m = in_order(std::vector<int>{3, 15, 7, 0, 12, 1, 2, 14, 4, 5, 6, 13, 8, 9, 10, 11}, Eigen::all);
    expect_null_space(m, eliminate(equations(m)));
    MatrixXd in_units = m;
    for (int c = 0; c < 30; c += 2) in_units.col(c) *= 1e6;
    for (int r = 0; r < 16; r += 3) in_units.row(r) *= 1e-5;
    const Elimination e = eliminate(equations(in_units));
    EXPECT_EQ(e.redundant.size(), eliminate(equations(m)).redundant.size());
  }
}

TEST(Elimination, keeps_and_tells_rows_that_are_nearly_redundant) {
  MatrixXd m(3, 4);
  m << 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, -1 - 1e-7, 0;
  const Elimination e = eliminate(equations(m));
  ASSERT_EQ(e.nearly_redundant.size(), 1u);
  EXPECT_NEAR(e.nearly_redundant[0].relative, 1e-7, 2e-8);
  EXPECT_EQ(e.independent, std::vector<int>{3});
  m(2, 2) = -1 - 1e-13;
  const Elimination f = eliminate(equations(m));
  EXPECT_TRUE(f.nearly_redundant.empty());
  EXPECT_EQ(f.redundant.size(), 1u);
}

// What is left of a row counts when all others have had their say: here the third row holds what the second nearly
// does.
TEST(Elimination, waits_with_rows_of_which_little_is_left) {
  MatrixXd m(4, 3);
  m << 1, 1, 0, 1, 1 + 1e-7, 0, 0, 1, 1, 0, 1, 2;
  const Elimination e = eliminate(equations(m));
  EXPECT_TRUE(e.nearly_redundant.empty());
  ASSERT_EQ(e.redundant.size(), 1u);
  EXPECT_TRUE(e.independent.empty());
}

TEST(Elimination, leaves_out_what_is_held) {
  MatrixXd m(2, 3);
  m << 1, -2, 0, 0, 1, 3;
  Equations e = equations(m);
  e.fixed[2] = true;
  const Elimination all = eliminate(e);
  EXPECT_EQ(all.T.cols(), 0);
  EXPECT_EQ(all.T.nonZeros(), 0);
  e.fixed = {false, true, true};
  EXPECT_EQ(eliminate(e).redundant.size(), 1u);
}

}  // namespace
}  // namespace dynalin::nastran_reader::elimination_test

#include "eigenvalues/zero_modes.h"

#include <gtest/gtest.h>

namespace dynalin::zero_modes_test {
namespace {

// e₃ → 2 e₂ → 6 e₁, and e₅ → 7 e₄ beside it.
TEST(last_links, of_two_chains_are_their_first_vectors) {
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(5, 5);
  N(0, 1) = 3, N(1, 2) = 2, N(3, 4) = 7;
  const Eigen::MatrixXd last = last_links(N);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(5, 5);
  expected.row(0).head(3).setOnes();
  expected.row(3).tail(2).setOnes();
  EXPECT_EQ(last, expected);
}

// e₂, e₃ → e₁, and e₄ → e₂ + 2 e₃: e₂ − e₃ is null, and ends no chain.
TEST(last_links, span_what_is_null_though_no_chain_ends_there) {
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(4, 4);
  N(0, 1) = 1, N(0, 2) = 1, N(1, 3) = 1, N(2, 3) = 2;
  const Eigen::MatrixXd last = last_links(N);
  EXPECT_TRUE((N * last).isZero(1e-15)) << last;
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(4, 4);
  expected.row(0) << 1, 1, 0, 1;
  expected(1, 2) = -1, expected(2, 2) = 1;
  EXPECT_EQ(last, expected);
}

// (10³⁰)³⁹⁹ is no number, and its direction is.
TEST(last_links, of_a_chain_that_grows_beyond_all_numbers_is_a_number) {
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(400, 400);
  N.diagonal(1).setConstant(1e30);
  const Eigen::MatrixXd last = last_links(N);
  EXPECT_EQ(last.row(0), Eigen::RowVectorXd::Ones(400));
  EXPECT_TRUE(last.bottomRows(399).isZero(0));
}

}  // namespace
}  // namespace dynalin::zero_modes_test

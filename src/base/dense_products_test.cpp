#include "base/dense_products.h"

#include <gtest/gtest.h>

namespace dynalin::dense_products_test {
namespace {

TEST(TransposedFactor, is_the_product_whether_most_entries_are_zero_or_none) {
  Eigen::MatrixXd dense(40, 30), b(40, 5);
  for (Eigen::Index k = 0; k < dense.size(); ++k) dense.data()[k] = static_cast<double>(k % 17) - 7.5;
  for (Eigen::Index k = 0; k < b.size(); ++k) b.data()[k] = static_cast<double>(k % 13) - 5;
  Eigen::MatrixXd sparse = Eigen::MatrixXd::Zero(40, 30);
  sparse.diagonal() = dense.diagonal();
  sparse(39, 2) = 3;
  for (const Eigen::MatrixXd& a : {dense, sparse}) {
    EXPECT_LT((TransposedFactor(a) * b - a.transpose() * b).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(TransposedFactor, of_no_rows_gives_nothing_in_its_size) {
  const Eigen::MatrixXd product = TransposedFactor(Eigen::MatrixXd(0, 3)) * Eigen::MatrixXd(0, 2);
  EXPECT_EQ(product, Eigen::MatrixXd::Zero(3, 2));
  EXPECT_EQ(TransposedFactor(Eigen::MatrixXd::Zero(4, 3)) * Eigen::MatrixXd::Ones(4, 2), Eigen::MatrixXd::Zero(3, 2));
}

TEST(TakeOut, leaves_what_is_orthogonal_to_the_first_columns) {
  const Eigen::MatrixXcd V = Eigen::MatrixXcd::Random(9, 4);
  const Eigen::VectorXcd before = Eigen::VectorXcd::Random(9);
  for (const Eigen::Index columns : {0, 3}) {
    Eigen::VectorXcd w = before;
    const Eigen::VectorXcd along = take_out(V, columns, w);
    const Eigen::VectorXcd expected = V.leftCols(columns).adjoint() * before;
    EXPECT_LT((along - expected).norm(), 1e-14);
    EXPECT_LT((w - (before - V.leftCols(columns) * expected)).norm(), 1e-14);
  }
}

TEST(TakeOut, of_some_columns_at_once_along_images_of_theirs) {
  const Eigen::MatrixXd V = Eigen::MatrixXd::Random(9, 4), before = Eigen::MatrixXd::Random(9, 2),
                        images = Eigen::MatrixXd::Random(9, 2);
  for (const Eigen::Index columns : {0, 3}) {
    Eigen::MatrixXd w = before;
    const Eigen::MatrixXd along = take_out(V, columns, images, w);
    const Eigen::MatrixXd expected = V.leftCols(columns).transpose() * images;
    EXPECT_EQ(along.rows(), columns);
    EXPECT_LT((along - expected).norm(), 1e-14);
    EXPECT_LT((w - (before - V.leftCols(columns) * expected)).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace dynalin::dense_products_test

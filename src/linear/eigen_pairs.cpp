#include "linear/eigen_pairs.h"

#include "linear/dense_products.h"

namespace dynalin {

namespace {

constexpr double largest = 1e150;  // its square is a number

// Of [N⁻¹ head; tail], where a tiny value beside long chains of zeros makes N⁻¹ too large for double.
Eigen::VectorXcd direction(const Eigen::MatrixXcd& N, const Eigen::VectorXcd& column) {
  using Long = std::complex<long double>;
  Eigen::Matrix<Long, Eigen::Dynamic, 1> x = column.cast<Long>();
  const Eigen::Matrix<Long, Eigen::Dynamic, 1> head = x.head(N.rows());
  const Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic> long_N = N.cast<Long>();
  x.head(N.rows()) = long_N.triangularView<Eigen::Upper>().solve(head);
  x.normalize();
  return x.cast<std::complex<double>>();
}

}  // namespace

void map_to_states(const ZeroModes& zero, EigenPairs& pairs) {
  const Eigen::Index n = zero.block.rows(), z = zero.count;
  if (z == 0) {
    pairs.right = zero.scale.asDiagonal() * pairs.right;
    pairs.left = zero.scale.cwiseInverse().asDiagonal() * pairs.left;
  } else {
    const Eigen::MatrixXcd C = zero.block.topRightCorner(z, n - z).cast<std::complex<double>>();
    Eigen::MatrixXcd full(n, pairs.right.cols());
    full.bottomRows(n - z) = pairs.right;
    full.topRows(z) = -C * pairs.right;
    for (Eigen::Index k = 0; k < full.cols(); ++k) {
      Eigen::MatrixXcd N = zero.block.topLeftCorner(z, z).cast<std::complex<double>>();
      N.diagonal().array() -= pairs.values[static_cast<std::size_t>(k)];
      if (pairs.values[static_cast<std::size_t>(k)] == 0.0) {  // the mean of a cluster around zero
        full.col(k).head(z).setZero();
        continue;
      }
      const Eigen::VectorXcd head = N.triangularView<Eigen::Upper>().solve(full.col(k).head(z));
      if (head.norm() < largest) {
        full.col(k).head(z) = head;
      } else {
        full.col(k) = direction(N, full.col(k));
      }
    }
    pairs.right = real_product(zero.right(), full);
    pairs.left = real_product(zero.left().rightCols(n - z), pairs.left);
  }
  pairs.right.colwise().normalize();
  pairs.left.colwise().normalize();
}

}  // namespace dynalin

#include "linear/eigen_pairs.h"

#include "linear/dense_products.h"

namespace dynalin {

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
      full.col(k).head(z) = N.triangularView<Eigen::Upper>().solve(full.col(k).head(z)).eval();
    }
    pairs.right = real_product(zero.right(), full);
    pairs.left = real_product(zero.left().rightCols(n - z), pairs.left);
  }
  pairs.right.colwise().normalize();
  pairs.left.colwise().normalize();
}

}  // namespace dynalin

#include "eigenvalues/dual_vectors.h"

#include <Eigen/LU>

#include "base/dense_products.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;
using ComplexMatrix = Eigen::MatrixXcd;

// Of pairs, then of the conjugates of complex ones.
ComplexMatrix with_conjugates(const EigenPairs& pairs, const ComplexMatrix& vectors) {
  std::vector<Index> complex;
  for (Index i = 0; i < vectors.cols(); ++i) {
    if (!pairs.real(i)) complex.push_back(i);
  }
  ComplexMatrix all(vectors.rows(), vectors.cols() + static_cast<Index>(complex.size()));
  all << vectors, vectors(Eigen::all, complex).conjugate();
  return all;
}

// No y_iᴴ x_j of another beside y_iᴴ x_i. Many that are next to nothing add up in the residuals, which count them.
bool are_dual(const ComplexMatrix& products) {
  constexpr double next_to_own = 0.1;
  const Eigen::VectorXd own = products.diagonal().cwiseAbs();
  if (!(own.minCoeff() > 0)) return false;
  Eigen::MatrixXd others = products.cwiseAbs();
  others.diagonal().setZero();
  return (others.rowwise().maxCoeff().array() <= next_to_own * own.array()).all();
}

}  // namespace

EigenPairs with_dual_vectors(EigenPairs pairs) {
  const Index count = pairs.right.cols();
  if (count == 0 || !pairs.right.allFinite() || !pairs.left.allFinite()) return pairs;
  const ComplexMatrix right = with_conjugates(pairs, pairs.right), left = with_conjugates(pairs, pairs.left);
  const ComplexMatrix products = adjoint_product(left, right);
  if (are_dual(products)) return pairs;
  const Eigen::VectorXd sizes = products.rowwise().lpNorm<Eigen::Infinity>();
  if (!(sizes.minCoeff() > 0)) return pairs;
  const ComplexMatrix of_unit_size = sizes.cwiseInverse().asDiagonal() * products,
                      rows = sizes.cwiseInverse().asDiagonal() * left.adjoint();
  ComplexMatrix dual = of_unit_size.partialPivLu().solve(rows).topRows(count).adjoint();
  dual.colwise().normalize();
  if (dual.allFinite() && are_dual(adjoint_product(with_conjugates(pairs, dual), right))) pairs.left = std::move(dual);
  return pairs;
}

}  // namespace dynalin

#include "nastran_reader/reduction.h"

#include <limits>

#include "base/dense_products.h"

namespace dynalin::nastran_reader {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr double cancelled_entry = 128 * std::numeric_limits<double>::epsilon();

// Dense where T is: chains in relative coordinates move everything behind a joint.
MatrixXd congruent(const RowMajor& X, const RowMajor& T) {
  if (X.nonZeros() == 0) return MatrixXd::Zero(T.cols(), T.cols());
  const RowMajor XT = X * T;
  constexpr double dense_from = 0.05;
  const double fill = double(T.nonZeros()) / (double(T.rows()) * double(T.cols()));
  if (fill < dense_from) {
    const RowMajor transposed = T.transpose();
    return MatrixXd(RowMajor(transposed * XT));
  }
  std::vector<Index> rows;
  for (Index r = 0; r < XT.outerSize(); ++r) {
    if (RowMajor::InnerIterator(XT, r)) rows.push_back(r);
  }
  MatrixXd left = MatrixXd::Zero(static_cast<Index>(rows.size()), T.cols()), right = left;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (RowMajor::InnerIterator it(T, rows[k]); it; ++it) left(static_cast<Index>(k), it.col()) = it.value();
    for (RowMajor::InnerIterator it(XT, rows[k]); it; ++it) right(static_cast<Index>(k), it.col()) = it.value();
  }
  return transposed_product(left, right);
}

MatrixXd cleaned(const SparseMatrix& X, const RowMajor& T, const RowMajor& T_size) {
  const RowMajor by_rows = X;
  MatrixXd m = congruent(by_rows, T);
  const MatrixXd size = congruent(by_rows.cwiseAbs(), T_size);
  m = (m.array().abs() <= cancelled_entry * size.array()).select(0, m);
  return m;
}

}  // namespace

Reduced reduce(const Equations& equations, const Elimination& elimination) {
  Reduced out;
  const RowMajor &T = elimination.T, T_size = T.cwiseAbs();
  const MatrixXd M = cleaned(equations.M, T, T_size), B = cleaned(equations.B, T, T_size),
                 K = cleaned(equations.K, T, T_size);
  const Eigen::MatrixXd sizes = M.cwiseAbs() + B.cwiseAbs() + K.cwiseAbs();
  for (Index k = 0; k < T.cols(); ++k) {
    const bool touched = sizes.row(k).any() || sizes.col(k).any();
    if (touched) {
      out.kept.push_back(static_cast<int>(k));
    } else {
      out.untouched.push_back(elimination.independent[static_cast<std::size_t>(k)]);
    }
  }
  out.M = M(out.kept, out.kept), out.B = B(out.kept, out.kept), out.K = K(out.kept, out.kept);
  return out;
}

}  // namespace dynalin::nastran_reader

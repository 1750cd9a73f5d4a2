#include "linear/zero_modes.h"

#include <lapacke.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;
constexpr double eps = std::numeric_limits<double>::epsilon();
// Entries of the blocks that are made in the splitting carry a few roundings more.
constexpr double margin = 2;

class Splitter {
 public:
  Splitter(const Matrix& A, const Matrix& rounding) : n_(A.rows()) {
    out_.block = A;
    out_.scale = Eigen::VectorXd::Ones(n_);
    lapack_int low = 0, high = 0;
    const auto n = static_cast<lapack_int>(n_);
    LAPACKE_dgebal(LAPACK_COL_MAJOR, 'S', n, out_.block.data(), n, &low, &high, out_.scale.data());
    // Rounding grows with what a row or column is multiplied with.
    rounding_ = out_.scale.cwiseInverse().asDiagonal() * rounding * out_.scale.asDiagonal();
    out_.basis = Matrix::Identity(n_, n_);
  }

  ZeroModes run() {
    for (Index before = -1; before < out_.count;) {
      before = out_.count;
      take_zero_columns();
      if (out_.count == before) take_null_space();
    }
    for (Index j = 0; j < out_.count; ++j) {
      for (Index i = 0; i < out_.count; ++i) {
        if (std::abs(out_.block(i, j)) <= margin * rounding_(i, j)) out_.block(i, j) = 0;
      }
    }
    return std::move(out_);
  }

 private:
  Index left() const { return n_ - out_.count; }
  auto core() { return out_.block.bottomRightCorner(left(), left()); }

  // Columns that are exactly zero are null directions as they stand; only those of this pass count, so that chains
  // keep their order.
  void take_zero_columns() {
    std::vector<Index> zero;
    for (Index j = out_.count; j < n_; ++j) {
      if (out_.block.col(j).tail(n_ - out_.count).isZero(0)) zero.push_back(j);
    }
    for (std::size_t k = 0; k < zero.size(); ++k) exchange(out_.count + static_cast<Index>(k), zero[k]);
    out_.count += static_cast<Index>(zero.size());
  }
  void exchange(Index a, Index b) {
    if (a == b) return;
    out_.block.row(a).swap(out_.block.row(b));
    out_.block.col(a).swap(out_.block.col(b));
    rounding_.row(a).swap(rounding_.row(b));
    rounding_.col(a).swap(rounding_.col(b));
    out_.basis.col(a).swap(out_.basis.col(b));
  }

  // What entries of (core · v) may be off, for columns v whose entries are known to a few units of the last place of
  // the largest; entries that are exactly zero stay out of it.
  Matrix tolerance(const Matrix& v) {
    const Index k = left();
    const Matrix size = core().cwiseAbs();
    Matrix inexact = (v.array() != 0).cast<double>();
    for (Index c = 0; c < v.cols(); ++c) inexact.col(c) *= 4 * eps * v.col(c).cwiseAbs().maxCoeff();
    return (rounding_.bottomRightCorner(k, k) + 4 * eps * size) * v.cwiseAbs() + size * inexact;
  }

  void take_null_space() {
    const Index k = left();
    if (k == 0) return;
    std::vector<Index> support(static_cast<std::size_t>(k));
    std::iota(support.begin(), support.end(), Index{0});
    const Matrix scaled = in_units_of_tolerance(support);
    if (!scaled.allFinite() || surely_regular(scaled)) return;
    const Eigen::ColPivHouseholderQR<Matrix> qr(scaled);
    Index rank = k;
    while (rank > 0 && std::abs(qr.matrixR()(rank - 1, rank - 1)) <= static_cast<double>(k)) --rank;
    for (; rank < k; ++rank) {
      Matrix v = null_vectors(qr, rank);
      if (is_null(v)) return rotate(v);
      // Once more among the columns that take part, in units of their own rows.
      support.clear();
      for (Index j = 0; j < k; ++j) {
        if (!v.row(j).isZero(0)) support.push_back(j);
      }
      const Eigen::ColPivHouseholderQR<Matrix> own(in_units_of_tolerance(support));
      const Matrix part = null_vectors(own, static_cast<Index>(support.size()) - v.cols());
      v.setZero();
      v(support, Eigen::all) = part;
      if (part.allFinite() && is_null(v)) return rotate(v);
    }
  }
  bool is_null(const Matrix& v) { return ((core() * v).array().abs() <= tolerance(v).array()).all(); }

  // Columns of the core with rows in units of what they may be off: singular values of about one and less are rounding.
  Matrix in_units_of_tolerance(const std::vector<Index>& columns) {
    Matrix ones = Matrix::Zero(left(), 1);
    ones(columns, Eigen::all).setOnes();
    const Eigen::VectorXd unit = tolerance(ones);
    Matrix scaled = core()(Eigen::all, columns);
    for (Index i = 0; i < scaled.rows(); ++i) {
      if (unit(i) > 0) scaled.row(i) /= unit(i);
    }
    return scaled;
  }

  // An estimate of ‖M⁻¹‖ far below one says that no direction is shrunk to rounding.
  static bool surely_regular(Matrix m) {
    const auto n = static_cast<lapack_int>(m.rows());
    const double norm = m.cwiseAbs().colwise().sum().maxCoeff();
    std::vector<lapack_int> pivots(static_cast<std::size_t>(n));
    if (LAPACKE_dgetrf(LAPACK_COL_MAJOR, n, n, m.data(), n, pivots.data()) != 0) return false;
    double reciprocal = 0;
    LAPACKE_dgecon(LAPACK_COL_MAJOR, '1', n, m.data(), n, norm, &reciprocal);
    return reciprocal * norm > 10.0 * static_cast<double>(n);
  }

  static Matrix null_vectors(const Eigen::ColPivHouseholderQR<Matrix>& qr, Index rank) {
    const Index k = qr.cols(), p = k - rank;
    Matrix v = Matrix::Zero(k, p);
    v.topRows(rank) = -qr.matrixR().topRightCorner(rank, p);
    qr.matrixR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solveInPlace(v.topRows(rank));
    v.bottomRows(p).setIdentity();
    for (Index c = 0; c < p; ++c) {
      const double least = 64 * eps * v.col(c).cwiseAbs().maxCoeff();
      v.col(c) = (v.col(c).array().abs() <= least).select(0.0, v.col(c));
    }
    return qr.colsPermutation() * v;
  }

  void rotate(const Matrix& v) {
    const Index k = left(), p = v.cols(), z = out_.count;
    const Eigen::HouseholderQR<Matrix> qr(v);
    const Matrix Q = qr.householderQ();
    out_.block.rightCols(k) = (out_.block.rightCols(k) * Q).eval();
    out_.block.bottomRows(k) = (Q.transpose() * out_.block.bottomRows(k)).eval();
    out_.block.block(z, z, k, p).setZero();
    out_.basis.rightCols(k) = (out_.basis.rightCols(k) * Q).eval();
    const Matrix absolute = Q.cwiseAbs();
    rounding_.rightCols(k) = (rounding_.rightCols(k) * absolute).eval();
    rounding_.bottomRows(k) = (absolute.transpose() * rounding_.bottomRows(k)).eval();
    // The products round as well.
    rounding_.bottomRightCorner(k, k).array() += 4 * eps * out_.block.bottomRightCorner(k, k).cwiseAbs().maxCoeff();
    out_.count += p;
  }

  Index n_;
  Matrix rounding_;
  ZeroModes out_;
};

}  // namespace

Matrix ZeroModes::vectors() const {
  Matrix v = Matrix::Identity(basis.rows(), count);
  const auto N = block.topLeftCorner(count, count);
  for (Index c = 0; c < count; ++c) {
    for (Eigen::VectorXd next = N * v.col(c).head(count); !next.isZero(0); next = N * next) v.col(c).head(count) = next;
  }
  return right() * v;
}

ZeroModes split_zero_modes(const Matrix& A, const Matrix& rounding) { return Splitter(A, rounding).run(); }

}  // namespace dynalin

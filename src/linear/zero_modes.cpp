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
// What the entries of a computed null direction are not exact to, relative to the largest.
constexpr double rounding_of_entries = 64 * eps;

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
    out_.basis = out_.dual = Matrix::Identity(n_, n_);
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
    out_.dual.col(a).swap(out_.dual.col(b));
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
      const Matrix v = null_vectors(qr, rank);
      if (split_off_sparsest(v)) return;
      // Once more among the columns that take part, in units of their own rows.
      support.clear();
      for (Index j = 0; j < k; ++j) {
        if (!without_small(v, rounding_of_entries).row(j).isZero(0)) support.push_back(j);
      }
      const Eigen::ColPivHouseholderQR<Matrix> own(in_units_of_tolerance(support));
      const Matrix part = null_vectors(own, static_cast<Index>(support.size()) - v.cols());
      if (!part.allFinite()) continue;
      Matrix among = Matrix::Zero(k, v.cols());
      among(support, Eigen::all) = part;
      if (split_off_sparsest(among)) return;
    }
  }
  // Null directions that are exactly zero where they may be keep equations apart that have nothing to do with them.
  bool split_off_sparsest(const Matrix& v) {
    for (const double least : {1e-8, 1e-10, 1e-12, rounding_of_entries, 0.0}) {
      Matrix sparse = without_small(v, least);
      if (!is_null(sparse)) continue;
      split_off(std::move(sparse));
      return true;
    }
    return false;
  }
  static Matrix without_small(Matrix v, double least) {
    for (Index c = 0; c < v.cols(); ++c) {
      const double size = v.col(c).cwiseAbs().maxCoeff();
      v.col(c) = (v.col(c).array().abs() <= least * size).select(0.0, v.col(c));
    }
    return v;
  }
  bool is_null(const Matrix& v) { return ((core() * v).array().abs() <= tolerance(v).array()).all(); }

  // Columns of the core with rows in units of what they may be off: singular values of about one and less are rounding.
  // Larger rows come first: only then does every row keep its own digits in an orthogonal factorization (Cox and
  // Higham, Stability of Householder QR factorization for weighted least squares problems).
  Matrix in_units_of_tolerance(const std::vector<Index>& columns) {
    Matrix ones = Matrix::Zero(left(), 1);
    ones(columns, Eigen::all).setOnes();
    const Eigen::VectorXd unit = tolerance(ones);
    Matrix scaled = core()(Eigen::all, columns);
    for (Index i = 0; i < scaled.rows(); ++i) {
      if (unit(i) > 0) scaled.row(i) /= unit(i);
    }
    const Eigen::VectorXd size = scaled.cwiseAbs().rowwise().maxCoeff();
    std::vector<Index> order(static_cast<std::size_t>(scaled.rows()));
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) { return size(i) > size(j); });
    return scaled(order, Eigen::all);
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
    return qr.colsPermutation() * v;
  }

  // Brings v to [1; W] with complete pivoting; entries that cancel are zero.
  void make_unit(Matrix& v) {
    for (Index c = 0; c < v.cols(); ++c) {
      Index row = 0, column = 0;
      v.bottomRightCorner(v.rows() - c, v.cols() - c).cwiseAbs().maxCoeff(&row, &column);
      v.col(c).swap(v.col(c + column));
      v.row(c).swap(v.row(c + row));
      exchange(out_.count + c, out_.count + c + row);
      v.col(c) /= v(c, c);
      for (Index other = 0; other < v.cols(); ++other) {
        if (other == c || v(c, other) == 0) continue;
        const Eigen::VectorXd share = v(c, other) * v.col(c);
        v.col(other) -= share;
        v.col(other) = (v.col(other).array().abs() <= 16 * eps * share.array().abs()).select(0.0, v.col(other));
      }
    }
  }

  void split_off(Matrix v) {
    make_unit(v);
    const Index k = left(), p = v.cols(), rest = k - p, z = out_.count;
    const Matrix W = v.bottomRows(rest), size = W.cwiseAbs();
    // Columns of the zero modes, in the rows of those before.
    rounding_.block(0, z, z, p) += rounding_.block(0, z + p, z, rest) * size;
    out_.block.block(0, z, z, p) += out_.block.block(0, z + p, z, rest) * W;
    out_.block.block(z, z, k, p).setZero();
    // Rows of what is left.
    const Matrix upper = out_.block.block(z, z + p, p, rest);
    rounding_.bottomRightCorner(rest, rest) += size * (rounding_.block(z, z + p, p, rest) + 8 * eps * upper.cwiseAbs());
    out_.block.bottomRightCorner(rest, rest) -= W * upper;
    out_.basis.middleCols(z, p) += out_.basis.rightCols(rest) * W;
    out_.dual.rightCols(rest) -= out_.dual.middleCols(z, p) * W.transpose();
    out_.count += p;
    core() = (core().array().abs() <= rounding_.bottomRightCorner(rest, rest).array()).select(0.0, core());
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

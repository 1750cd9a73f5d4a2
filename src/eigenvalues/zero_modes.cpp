#include "eigenvalues/zero_modes.h"

#include <lapacke.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "eigenvalues/rounding.h"
#include "eigenvalues/triangular_form.h"
#include "linear/balanced.h"
#include "structural_zeros/carried_forces.h"
#include "structural_zeros/structural_zeros.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;
// Entries of the blocks that are made in the splitting carry a few roundings more.
constexpr double margin = 2;
// What states drive is solved for where it is no nearer to a singular matrix.
constexpr double regular = 1e-10;
// What the entries of a computed null direction are not exact to, relative to the largest.
constexpr double rounding_of_entries = 64 * eps;
// What the matrix may make of a direction that is null, in units of its roundings.
constexpr double most_excess = 1e4;
// LAPACK's estimates of the norm of an inverse are rarely off by more than three.
constexpr double margin_of_estimate = 10;

class Splitter {
 public:
  Splitter(const Matrix& A, const Matrix& rounding, const StructuralZeros* motions)
      : n_(A.rows()), motions_(motions), state_(static_cast<std::size_t>(n_)) {
    std::iota(state_.begin(), state_.end(), std::size_t{0});
    // Rounding must not decide about units: what it leaves of zeros would be blown up to the size of the rest.
    Balanced b = balanced((A.array().abs() <= rounding.array()).select(0.0, A));
    rounding_ = b.of(rounding);
    out_.block = b.of(A);
    out_.scale = std::move(b.scale);
    out_.basis = out_.dual = Matrix::Identity(n_, n_);
  }

  ZeroModes run() {
    while (left() > 0 && (take_zero_columns() || take_state_that_nothing_holds() || take_motions())) continue;
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
  bool take_zero_columns() {
    std::vector<Index> zero;
    for (Index j = out_.count; j < n_; ++j) {
      if (out_.block.col(j).tail(n_ - out_.count).isZero(0)) zero.push_back(j);
    }
    for (std::size_t k = 0; k < zero.size(); ++k) exchange(out_.count + static_cast<Index>(k), zero[k]);
    out_.count += static_cast<Index>(zero.size());
    return !zero.empty();
  }
  void exchange(Index a, Index b) {
    if (a == b) return;
    out_.block.row(a).swap(out_.block.row(b));
    out_.block.col(a).swap(out_.block.col(b));
    rounding_.row(a).swap(rounding_.row(b));
    rounding_.col(a).swap(rounding_.col(b));
    out_.basis.col(a).swap(out_.basis.col(b));
    out_.dual.col(a).swap(out_.dual.col(b));
    std::swap(state_[static_cast<std::size_t>(a)], state_[static_cast<std::size_t>(b)]);
  }

  // A state alone in its block of the triangular form, zero on the diagonal, and all that it drives: what it reaches
  // is regular once the zeros there are split off.
  bool take_state_that_nothing_holds() {
    for (const std::vector<Index>& block : connected_components(core())) {
      const Index i = block.front();
      if (block.size() > 1 || core()(i, i) != 0.0) continue;
      Matrix v = Matrix::Zero(left(), 1);
      v(i, 0) = 1;
      const std::vector<Index> reached = reached_from(core(), i);
      if (!reached.empty()) {
        const Eigen::PartialPivLU<Matrix> driven(core()(reached, reached));
        if (!(driven.rcond() > regular)) continue;  // motions among them are taken first
        v(reached, 0) = -driven.solve(core()(reached, std::vector<Index>{i}));
      }
      if (!v.allFinite() || !(excess(v) <= 1)) continue;
      // The state itself is the pivot, and the triangular form stays.
      v.row(0).swap(v.row(i));
      exchange(out_.count, out_.count + i);
      eliminate(v);
      return true;
    }
    return false;
  }

  // Motions that no element feels.
  bool take_motions() {
    if (!motions_ || !may_be_singular()) return false;
    Matrix v = motions(vanishing);
    // What the matrix makes of them beyond its own roundings may be a direction in which elements are soft: then they
    // must not feel it at all.
    if (v.cols() > 0 && excess(v) > 1) v = motions(surely_vanishing);
    return v.cols() > 0 && split_off_sparsest(v);
  }
  // In the core, none where they cannot be told.
  Matrix motions(double limit) {
    const Matrix found = motions_->beyond(out_.right().leftCols(out_.count), limit);
    Matrix v = out_.scale.cwiseInverse().asDiagonal() * found;
    v.colwise().normalize();
    v = (out_.dual.transpose() * v).bottomRows(left()).eval();
    if (v.cols() > 0) follow(v);
    return v.allFinite() ? v : Matrix(left(), 0);
  }
  // What a motion does to states that only follow it.
  void follow(Matrix& v) {
    std::vector<Index> followers, others;
    for (Index k = 0; k < left(); ++k) {
      (motions_->driven()[state_[static_cast<std::size_t>(out_.count + k)]] ? followers : others).push_back(k);
    }
    if (followers.empty()) return;
    const Eigen::PartialPivLU<Matrix> own(core()(followers, followers));
    if (!(own.rcond() > regular)) {
      v.resize(v.rows(), 0);
    } else {
      v(followers, Eigen::all) = -own.solve(core()(followers, others) * v(others, Eigen::all));
    }
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

  bool may_be_singular() {
    Matrix scaled = in_units_of_tolerance();
    return scaled.allFinite() && !surely_regular(std::move(scaled));
  }
  // Null directions that are exactly zero where they may be keep equations apart that have nothing to do with them.
  // What the matrix makes of them may be a good deal more than its roundings where the model lies far from the origin:
  // that they are null is proved elsewhere.
  bool split_off_sparsest(const Matrix& v) {
    const double as_given = excess(v);
    const bool is_small = as_given <= 1 || (core() * v).norm() <= 1e-6 * core().norm() * v.norm();
    if (!(as_given <= most_excess) || !is_small) return false;
    for (const double least : {1e-8, 1e-10, 1e-12, rounding_of_entries, 0.0}) {
      Matrix sparse = without_small(v, least);
      if (excess(sparse) > std::max(1.0, 2 * as_given)) continue;
      return split_off(std::move(sparse));
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
  // The largest entry of (core · v) in units of what it may be off.
  double excess(const Matrix& v) {
    const Matrix image = (core() * v).cwiseAbs(), allowed = tolerance(v);
    double worst = 0;
    for (Index c = 0; c < image.cols(); ++c) {
      for (Index r = 0; r < image.rows(); ++r) {
        if (image(r, c) > 0) worst = std::max(worst, image(r, c) / allowed(r, c));
      }
    }
    return worst;
  }

  // The core with rows in units of what they may be off: singular values of about one and less are rounding.
  Matrix in_units_of_tolerance() {
    const Eigen::VectorXd unit = tolerance(Matrix::Ones(left(), 1));
    Matrix scaled = core();
    for (Index i = 0; i < scaled.rows(); ++i) {
      if (unit(i) > 0) scaled.row(i) /= unit(i);
    }
    return scaled;
  }

  // Whether no direction can be split off: |M v| of each has an entry of |v|/‖M⁻¹‖ or more, in the largest norm, which
  // is more than split_off_sparsest takes.
  static bool surely_regular(Matrix m) {
    const auto n = static_cast<lapack_int>(m.rows());
    std::vector<lapack_int> pivots(static_cast<std::size_t>(n));
    if (LAPACKE_dgetrf(LAPACK_COL_MAJOR, n, n, m.data(), n, pivots.data()) != 0) return false;
    double least = 0;  // an estimate of 1/‖M⁻¹‖
    LAPACKE_dgecon(LAPACK_COL_MAJOR, 'I', n, m.data(), n, 1.0, &least);
    return least > margin_of_estimate * most_excess;
  }

  // Brings v to [1; W] with complete pivoting; entries that cancel are zero. Columns that depend on others go: motions
  // that differ in states which only follow them are one.
  void make_unit(Matrix& v) {
    constexpr double dependent = 1e-9;  // of unit vectors
    for (Index c = 0; c < v.cols(); ++c) {
      Index row = 0, column = 0;
      const double most = v.bottomRightCorner(v.rows() - c, v.cols() - c).cwiseAbs().maxCoeff(&row, &column);
      if (!(most > dependent)) {
        v.conservativeResize(Eigen::NoChange, c);
        return;
      }
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

  bool split_off(Matrix v) {
    make_unit(v);
    if (v.cols() == 0) return false;
    eliminate(v);
    return true;
  }
  // Takes directions [1; W] out.
  void eliminate(const Matrix& v) {
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
  }

  Index n_;
  const StructuralZeros* motions_;
  std::vector<std::size_t> state_;  // that stands at each place of the block
  Matrix rounding_;
  ZeroModes out_;
};

}  // namespace

Matrix last_links(const Matrix& chains) {
  constexpr double cancelled = 1e-12;  // of what is added up: nothing
  const Index count = chains.rows();
  Matrix v = Matrix::Identity(count, count), images = chains, combinations = v;
  std::vector<std::pair<Index, Index>> pivots;  // column of images, and the row of its pivot
  for (Index c = 0; c < count; ++c) {
    // What earlier columns of N make of it is taken off, and of the vectors alike: where nothing is left, a combination
    // of links is null that no chain ends with.
    Eigen::VectorXd combination = Eigen::VectorXd::Unit(count, c);
    for (const auto& [column, row] : pivots) {
      if (images(row, c) == 0) continue;
      const double share = images(row, c) / images(row, column);
      const Eigen::VectorXd part = share * images.col(column);
      const Eigen::VectorXd sum = images.col(c).cwiseAbs() + part.cwiseAbs();
      images.col(c) -= part;
      images.col(c) = (images.col(c).array().abs() <= cancelled * sum.array()).select(0.0, images.col(c));
      images(row, c) = 0;
      combination -= share * combinations.col(column);
    }
    combinations.col(c) = combination;
    Index row = 0;
    if (images.col(c).cwiseAbs().maxCoeff(&row) == 0 && combination.allFinite()) {
      v.col(c) = combination / combination.cwiseAbs().maxCoeff();
      continue;
    }
    pivots.emplace_back(c, row);
    // Each link ends above the one before. Along a chain lengths may grow beyond all numbers.
    for (Index top = c; top > 0; --top) {
      const Eigen::VectorXd next = chains.topLeftCorner(top, top + 1) * v.col(c).head(top + 1);
      while (top > 0 && next(top - 1) == 0) --top;
      if (top == 0) break;
      v.col(c).setZero();
      v.col(c).head(top) = next.head(top) / next.head(top).cwiseAbs().maxCoeff();
    }
  }
  return v;
}

Matrix ZeroModes::vectors() const {
  Matrix v = Matrix::Zero(basis.rows(), count);
  v.topRows(count) = last_links(block.topLeftCorner(count, count));
  return right() * v;
}

ZeroModes split_zero_modes(const Matrix& A, const Matrix& rounding, const StructuralZeros* motions) {
  return Splitter(A, rounding, motions).run();
}

}  // namespace dynalin

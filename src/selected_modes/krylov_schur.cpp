#include "selected_modes/krylov_schur.h"

#include <fmt/format.h>
#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <optional>
#include <vector>

#include "base/arbitrary_vector.h"
#include "base/dense_products.h"
#include "distributed/krylov_progress.h"
#include "eigenvalues/rounding.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using ComplexVector = Eigen::VectorXcd;
using ComplexMatrix = Eigen::MatrixXcd;

lapack_complex_double* raw(ComplexMatrix& m) { return reinterpret_cast<lapack_complex_double*>(m.data()); }

// H = U T Uᴴ; H becomes T. False if the QR iteration does not converge.
bool schur(ComplexMatrix& H, ComplexMatrix& U) {
  const auto n = static_cast<lapack_int>(H.rows());
  U.resize(n, n);
  lapack_int sorted = 0;
  ComplexVector values(n);
  const lapack_int info = LAPACKE_zgees(LAPACK_COL_MAJOR, 'V', 'N', nullptr, n, raw(H), n, &sorted,
                                        reinterpret_cast<lapack_complex_double*>(values.data()), raw(U), n);
  if (info == LAPACK_WORK_MEMORY_ERROR || info == LAPACK_TRANSPOSE_MEMORY_ERROR) throw std::bad_alloc();
  return info == 0;
}

// Moves the value at `from` of a Schur form up to `to`.
void move_value(ComplexMatrix& T, ComplexMatrix& U, Index from, Index to) {
  if (from == to) return;
  const auto n = static_cast<lapack_int>(T.rows());
  LAPACKE_ztrexc(LAPACK_COL_MAJOR, 'V', n, raw(T), n, raw(U), n, static_cast<lapack_int>(from + 1),
                 static_cast<lapack_int>(to + 1));
}

// The largest values first.
void sort_by_size(ComplexMatrix& T, ComplexMatrix& U) {
  for (Index k = 0; k + 1 < T.rows(); ++k) {
    Index largest = k;
    for (Index j = k + 1; j < T.rows(); ++j) {
      if (std::abs(T(j, j)) > std::abs(T(largest, largest)) * (1 + 4 * eps)) largest = j;
    }
    move_value(T, U, largest, k);
  }
}

// A Krylov space beside columns Q that are locked, Op Q = Q T:
//
//     Op V = Q C + V H + v b        v the vector behind those of the space, b = β e_last until H is brought to Schur
//     form
class KrylovSpace {
 public:
  using Operator = KrylovSchur::Operator;

  // Of so many vectors; `starts` counts the start vectors that were taken.
  KrylovSpace(const Operator& op, const ComplexMatrix& locked, Index most, unsigned& starts)
      : op_(op),
        size_(locked.rows()),
        locked_(locked.cols()),
        most_(most),
        starts_(starts),
        V_(size_, locked_ + most + 1),
        C_(ComplexMatrix::Zero(locked_, most)),
        H_(ComplexMatrix::Zero(most, most)) {
    V_.leftCols(locked_) = locked;
    start_at(locked_);
  }

  // Fills the space and brings H to Schur form, the largest values first; false if that fails.
  bool fill() {
    b_ = Eigen::RowVectorXcd::Zero(most_);
    for (Index j = kept_; j < most_; ++j) {
      if (!extend(j)) return false;
    }
    ComplexMatrix U;
    if (!schur(H_, U)) return false;
    sort_by_size(H_, U);
    b_ = (b_ * U).eval();
    V_.middleCols(locked_, most_) = product(V_.middleCols(locked_, most_), U);
    if (locked_ > 0) C_ = (C_ * U).eval();
    return true;
  }

  KrylovProgress::Value value(Index k) const { return {std::abs(H_(k, k)), std::abs(b_(k))}; }
  // So many of the first are found.
  Index found() const {
    Index found = 0;
    while (found < most_ && KrylovProgress::is_found(value(found), value(0).size)) ++found;
    return found;
  }
  // Behind the first `found`, if anything is left over of them.
  std::vector<Complex> others(Index found) const {
    std::vector<Complex> values;
    if (found == most_ || !(std::abs(b_(found)) > 0)) return values;
    for (Index k = found; k < most_; ++k) values.push_back(H_(k, k));
    return values;
  }

  // Goes on from the first `kept` vectors.
  void restart(Index kept) {
    V_.col(locked_ + kept) = V_.col(locked_ + most_).eval();
    const ComplexMatrix head = H_.topLeftCorner(kept, kept);
    H_.setZero();
    H_.topLeftCorner(kept, kept) = head;
    H_.row(kept).head(kept) = b_.head(kept);
    kept_ = kept;
  }

  // What Q and T become with the first `found`.
  ComplexMatrix basis(Index found) const { return V_.leftCols(locked_ + found); }
  ComplexMatrix triangle(const ComplexMatrix& of_locked, Index found) const {
    ComplexMatrix T = ComplexMatrix::Zero(locked_ + found, locked_ + found);
    T.topLeftCorner(locked_, locked_) = of_locked;
    T.topRightCorner(locked_, found) = C_.leftCols(found);
    T.bottomRightCorner(found, found) = H_.topLeftCorner(found, found);
    return T;
  }

 private:
  // Without its parts along the first `columns` of V, which are put into `share`.
  void take_out_all(ComplexVector& w, Index columns, ComplexVector& share) const {
    share = ComplexVector::Zero(columns);
    for (int pass = 0; pass < 2; ++pass) share += take_out(V_, columns, w);
  }

  void start_at(Index column) {
    for (;;) {
      ComplexVector v = arbitrary_vector(size_, 100 + starts_++), ignored;
      take_out_all(v, column, ignored);
      take_out_all(v, column, ignored);
      const double norm = v.norm();
      if (!(norm > 1e-8)) continue;
      V_.col(column) = v / norm;
      return;
    }
  }

  // By the image of the j-th vector; false if it is not finite.
  bool extend(Index j) {
    const Index columns = locked_ + j + 1;
    ComplexVector w = V_.col(columns - 1), share;
    op_(w);
    if (!w.allFinite()) return false;
    const double size = w.norm();
    take_out_all(w, columns, share);
    C_.col(j) = share.head(locked_);
    H_.col(j).head(j + 1) = share.tail(j + 1);
    double rest = w.norm();
    const bool last = columns == size_;
    if (!last && rest > 16 * eps * size) {
      V_.col(columns) = w / rest;
    } else {
      rest = 0;
      if (!last) start_at(columns);
    }
    if (j + 1 < most_) {
      H_(j + 1, j) = rest;
    } else {
      b_(j) = rest;
    }
    return true;
  }

  const Operator& op_;
  const Index size_, locked_, most_;
  unsigned& starts_;
  ComplexMatrix V_, C_, H_;
  Eigen::RowVectorXcd b_;
  Index kept_ = 0;  // columns of the space that is gone on from
};

}  // namespace

bool KrylovSchur::run(const Operator& op, Index wanted, double least, int restarts) {
  in_sight_.clear();
  if (everything()) return true;
  const Index most = std::min(size_ - found(), KrylovProgress::vectors_for(wanted));
  wanted = std::min(wanted, most);
  const KrylovTask task{Q_, arbitrary_vector(size_, 100 + starts_), wanted, most, least, restarts};
  if (const auto of_team = krylov_run_of_team(op, task); of_team && take(*of_team)) {
    ++starts_;
    in_sight_ = of_team->in_sight;
    return of_team->converged;
  }
  KrylovSpace space(op, Q_, most, starts_);
  KrylovProgress progress(wanted, least);
  for (int restart = 0; restart < restarts; ++restart) {
    if (!space.fill()) return false;
    const Index done = space.found();
    progress_.tell([&] {
      return fmt::format("{} of {} eigenvalues, restart {}", found() + std::min(done, wanted), found() + wanted,
                         restart);
    });
    progress.look(done, most, done > 0 ? space.value(done - 1).size : 0,
                  done < most ? std::optional(space.value(done)) : std::nullopt);
    if (progress.has_reached_its_end() || restart + 1 == restarts || progress.stands_still()) {
      in_sight_ = space.others(done);
      T_ = space.triangle(T_, done);
      Q_ = space.basis(done);
      return progress.has_reached_its_end();
    }
    // What has converged stays in the space that is gone on from, and half of the rest.
    space.restart(std::min(most - 1, done + std::max<Index>(1, (most - done) / 2)));
  }
  return false;
}

bool KrylovSchur::take(const KrylovRun& run) {
  constexpr double invariant = 1e-9;  // what others call converged may be a little more than it is here
  const Index locked = found(), more = run.basis.cols();
  ComplexMatrix Q(size_, locked + more);
  Q << Q_, run.basis;
  const ComplexMatrix H = adjoint_product(Q, run.images);
  ComplexMatrix triangle = H.bottomRows(more), U;
  const double outside = (run.images - product(Q, H)).norm();
  if (more > 0) {
    if (!schur(triangle, U)) return false;
    sort_by_size(triangle, U);
    if (!(outside <= invariant * std::abs(triangle(more - 1, more - 1)))) return false;
    Q.rightCols(more) = product(run.basis, U);
  }
  ComplexMatrix T = ComplexMatrix::Zero(locked + more, locked + more);
  T.topLeftCorner(locked, locked) = T_;
  if (more > 0) {
    T.topRightCorner(locked, more) = H.topRows(locked) * U;
    T.bottomRightCorner(more, more) = triangle.triangularView<Eigen::Upper>();
  }
  T_ = std::move(T), Q_ = std::move(Q);
  return true;
}

Index KrylovSchur::order(const std::function<bool(Complex)>& first) {
  ComplexMatrix U = ComplexMatrix::Identity(found(), found());
  Index front = 0;
  for (Index k = 0; k < found(); ++k) {
    if (first(T_(k, k))) move_value(T_, U, k, front++);
  }
  Q_ = product(Q_, U);
  return front;
}

}  // namespace dynalin

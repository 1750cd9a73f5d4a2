#include "selected_modes/krylov_schur.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <optional>

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

}  // namespace

bool KrylovSchur::run(const Operator& op, Index wanted, double least, int restarts) {
  in_sight_.clear();
  const Index locked = found();
  if (locked == size_) return true;
  const Index most = std::min(size_ - locked, std::max<Index>(2 * wanted + 6, wanted + 20));
  wanted = std::min(wanted, most);
  const KrylovTask task{Q_, arbitrary_vector(size_, 100 + starts_), wanted, most, least, restarts};
  if (const auto of_team = krylov_run_of_team(op, task); of_team && take(*of_team)) {
    ++starts_;
    in_sight_ = of_team->in_sight;
    return of_team->converged;
  }
  ComplexMatrix V(size_, locked + most + 1), C = ComplexMatrix::Zero(locked, most), H = ComplexMatrix::Zero(most, most);
  V.leftCols(locked) = Q_;
  // Without its parts along the first `columns` of V, which are added to `share`.
  const auto without = [&](ComplexVector& w, Index columns, ComplexVector& share) {
    share = ComplexVector::Zero(columns);
    for (int pass = 0; pass < 2; ++pass) share += take_out(V, columns, w);
  };
  const auto start_at = [&](Index column) {
    for (;;) {
      ComplexVector v = arbitrary_vector(size_, 100 + starts_++), ignored;
      without(v, column, ignored);
      without(v, column, ignored);
      const double norm = v.norm();
      if (!(norm > 1e-8)) continue;
      V.col(column) = v / norm;
      return;
    }
  };
  start_at(locked);
  Index kept = 0;  // columns of the space that is gone on from
  Eigen::RowVectorXcd b;
  KrylovProgress progress(wanted, least);
  for (int restart = 0; restart < restarts; ++restart) {
    b = Eigen::RowVectorXcd::Zero(most);
    for (Index j = kept; j < most; ++j) {
      const Index columns = locked + j + 1;
      ComplexVector w = V.col(columns - 1), share;
      op(w);
      if (!w.allFinite()) return false;
      const double size = w.norm();
      without(w, columns, share);
      C.col(j) = share.head(locked);
      H.col(j).head(j + 1) = share.tail(j + 1);
      double rest = w.norm();
      const bool last = columns == size_;
      if (!last && rest > 16 * eps * size) {
        V.col(columns) = w / rest;
      } else {
        rest = 0;
        if (!last) start_at(columns);
      }
      if (j + 1 < most) {
        H(j + 1, j) = rest;
      } else {
        b(j) = rest;
      }
    }
    ComplexMatrix U;
    if (!schur(H, U)) return false;
    sort_by_size(H, U);
    b = (b * U).eval();
    V.middleCols(locked, most) = product(V.middleCols(locked, most), U);
    if (locked > 0) C = (C * U).eval();
    const auto value = [&](Index k) { return KrylovProgress::Value{std::abs(H(k, k)), std::abs(b(k))}; };
    Index done = 0;
    while (done < most && KrylovProgress::is_found(value(done), value(0).size)) ++done;
    progress.look(done, most, done > 0 ? value(done - 1).size : 0,
                  done < most ? std::optional(value(done)) : std::nullopt);
    if (progress.has_reached_its_end() || restart + 1 == restarts || progress.stands_still()) {
      if (done < most && std::abs(b(done)) > 0) {
        for (Index k = done; k < most; ++k) in_sight_.push_back(H(k, k));
      }
      ComplexMatrix T = ComplexMatrix::Zero(locked + done, locked + done);
      T.topLeftCorner(locked, locked) = T_;
      T.topRightCorner(locked, done) = C.leftCols(done);
      T.bottomRightCorner(done, done) = H.topLeftCorner(done, done);
      T_ = std::move(T);
      Q_ = V.leftCols(locked + done);
      return progress.has_reached_its_end();
    }
    // What has converged stays in the space that is gone on from, and half of the rest.
    kept = std::min(most - 1, done + std::max<Index>(1, (most - done) / 2));
    V.col(locked + kept) = V.col(locked + most).eval();
    const ComplexMatrix head = H.topLeftCorner(kept, kept);
    H.setZero();
    H.topLeftCorner(kept, kept) = head;
    H.row(kept).head(kept) = b.head(kept);
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

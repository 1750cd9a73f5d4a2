#include "structural_zeros/null_space.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

namespace dynalin {

namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;

struct Factors {
  Matrix m;  // R in its upper triangle
  std::vector<lapack_int> pivots;
  Index rank = 0;
};

// LAPACK's QR with column pivoting: blocked, where Eigen takes a column at a time.
Factors factored(Matrix m, double limit) {
  const Index columns = m.cols();
  Factors f{std::move(m), std::vector<lapack_int>(static_cast<std::size_t>(columns), 0), columns};
  Eigen::VectorXd scalars(columns);
  const auto height = static_cast<lapack_int>(f.m.rows());
  if (LAPACKE_dgeqp3(LAPACK_COL_MAJOR, height, static_cast<lapack_int>(columns), f.m.data(), height, f.pivots.data(),
                     scalars.data()) != 0)
    throw std::bad_alloc();
  while (f.rank > 0 && std::abs(f.m(f.rank - 1, f.rank - 1)) <= limit) --f.rank;
  return f;
}

// Of each column the rows with its two largest entries: mostly enough to show that nothing is in the null space.
Matrix telling_rows(const Matrix& m) {
  std::vector<Index> chosen;
  for (Index c = 0; c < m.cols(); ++c) {
    Index first = 0, second = m.rows() > 1 ? 1 : 0;
    for (Index r = 0; r < m.rows(); ++r) {
      if (std::abs(m(r, c)) > std::abs(m(first, c))) {
        second = first, first = r;
      } else if (r != first && std::abs(m(r, c)) > std::abs(m(second, c))) {
        second = r;
      }
    }
    chosen.push_back(first), chosen.push_back(second);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return m(chosen, Eigen::all);
}

}  // namespace

Matrix null_space(const std::vector<Eigen::RowVectorXd>& rows, Index columns, double limit) {
  Matrix m = Matrix::Zero(std::max(static_cast<Index>(rows.size()), columns), columns);
  for (std::size_t r = 0; r < rows.size(); ++r) m.row(static_cast<Index>(r)) = rows[r];
  if (!m.allFinite()) return Matrix(columns, 0);
  if (columns == 0) return Matrix(0, 0);
  if (Matrix few = telling_rows(m); few.rows() >= columns && factored(std::move(few), limit).rank == columns)
    return Matrix(columns, 0);
  const Factors f = factored(std::move(m), limit);
  const Index rank = f.rank;
  if (rank == columns) return Matrix(columns, 0);
  Matrix v = Matrix::Zero(columns, columns - rank);
  v.topRows(rank) = -f.m.topRightCorner(rank, columns - rank);
  f.m.topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solveInPlace(v.topRows(rank));
  v.bottomRows(columns - rank).setIdentity();
  Matrix in_order(columns, columns - rank);
  for (Index k = 0; k < columns; ++k) in_order.row(f.pivots[static_cast<std::size_t>(k)] - 1) = v.row(k);
  return in_order;
}

Index independent_columns(const Eigen::ColPivHouseholderQR<Matrix>& qr) {
  const Index most = std::min(qr.rows(), qr.cols());
  Index rank = 0;
  while (rank < most && std::abs(qr.matrixR()(rank, rank)) > another_direction) ++rank;
  return rank;
}

}  // namespace dynalin

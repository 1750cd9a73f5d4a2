#include "analysis/rank_split.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;

}  // namespace

RankSplit rank_split(const Matrix& values, const Matrix& sizes) {
  const Index n = values.rows();
  Matrix v = values, s = sizes;
  std::vector<Index> row, column;
  for (Index k = 0; k < n; ++k) row.push_back(k), column.push_back(k);
  // Entries are compared in units of their row, which may have any size.
  Eigen::VectorXd unit(n);
  for (Index k = 0; k < n; ++k) unit(k) = std::max(v.row(k).cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  Index rank = 0;
  for (; rank < n; ++rank) {
    Index r = -1, c = -1;
    double best = 0;
    for (Index i = rank; i < n; ++i) {
      for (Index j = rank; j < n; ++j) {
        const double x = std::abs(v(i, j));
        if (x > cancelled_units * std::numeric_limits<double>::epsilon() * s(i, j) && x / unit(i) > best)
          best = x / unit(i), r = i, c = j;
      }
    }
    if (r < 0) break;
    v.row(r).swap(v.row(rank)), s.row(r).swap(s.row(rank)), std::swap(unit(r), unit(rank));
    v.col(c).swap(v.col(rank)), s.col(c).swap(s.col(rank));
    std::swap(row[static_cast<std::size_t>(r)], row[static_cast<std::size_t>(rank)]);
    std::swap(column[static_cast<std::size_t>(c)], column[static_cast<std::size_t>(rank)]);
    for (Index i = rank + 1; i < n; ++i) {
      const double factor = v(i, rank) / v(rank, rank);
      if (factor == 0) continue;
      for (Index j = rank + 1; j < n; ++j) {
        v(i, j) -= factor * v(rank, j);
        s(i, j) += std::abs(factor) * s(rank, j);
      }
    }
  }
  RankSplit out;
  const auto at = [](const std::vector<Index>& x, Index k) { return x[static_cast<std::size_t>(k)]; };
  for (Index k = 0; k < n; ++k) {
    (k < rank ? out.pivot_row : out.other_row).push_back(at(row, k));
    (k < rank ? out.pivot_column : out.other_column).push_back(at(column, k));
  }
  const Index open = n - rank;
  out.right_null = out.left_null = Matrix::Zero(n, open);
  Matrix regular(rank, rank), right(rank, open), below(open, rank);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double x = values(at(row, i), at(column, j));
      if (i < rank && j < rank) regular(i, j) = x;
      if (i < rank && j >= rank) right(i, j - rank) = x;
      if (i >= rank && j < rank) below(i - rank, j) = x;
    }
  }
  if (rank > 0 && open > 0) {
    const Eigen::PartialPivLU<Matrix> lu(regular);
    const Matrix r = -lu.solve(right), l = -regular.transpose().partialPivLu().solve(below.transpose());
    for (Index k = 0; k < rank; ++k) {
      out.right_null.row(at(column, k)) = r.row(k);
      out.left_null.row(at(row, k)) = l.row(k);
    }
  }
  for (Index k = 0; k < open; ++k) {
    out.right_null(at(column, rank + k), k) = 1;
    out.left_null(at(row, rank + k), k) = 1;
  }
  return out;
}

}  // namespace dynalin

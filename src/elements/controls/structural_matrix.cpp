#include "elements/controls/structural_matrix.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace dynalin {

namespace {

constexpr double part_that_cancels = 1e-10;  // what numbers that cancel may leave, of their sizes

// a − factor · b
StructuralEntry less(const StructuralEntry& a, double factor, const StructuralEntry& b) {
  if (b.is_zero()) return a;
  if (a.is_any || b.is_any) return StructuralEntry::any();
  const double difference = a.number - factor * b.number;
  return {std::abs(difference) > part_that_cancels * (std::abs(a.number) + std::abs(factor * b.number)) ? difference
                                                                                                        : 0};
}

}  // namespace

StructuralMatrix StructuralMatrix::columns_only(const std::vector<std::size_t>& columns) const {
  StructuralMatrix m(rows_, columns.size());
  for (std::size_t r = 0; r < rows_; ++r) {
    for (std::size_t c = 0; c < columns.size(); ++c) m(r, c) = (*this)(r, columns[c]);
  }
  return m;
}

std::size_t StructuralMatrix::term_rank(std::vector<std::size_t>& row_of) const {
  std::vector<std::size_t> column_of(rows_, columns_);
  std::vector<bool> seen;
  const std::function<bool(std::size_t)> match = [&](std::size_t c) {
    for (const bool free_only : {true, false}) {
      for (std::size_t r = 0; r < rows_; ++r) {
        if (seen[r] || (*this)(r, c).is_zero() || (free_only && column_of[r] != columns_)) continue;
        seen[r] = true;
        if (column_of[r] != columns_ && !match(column_of[r])) continue;
        column_of[r] = c;
        return true;
      }
    }
    return false;
  };
  std::size_t rank = 0;
  for (std::size_t c = 0; c < columns_; ++c) {
    seen.assign(rows_, false);
    rank += match(c);
  }
  row_of.assign(columns_, rows_);
  for (std::size_t r = 0; r < rows_; ++r) {
    if (column_of[r] != columns_) row_of[column_of[r]] = r;
  }
  return rank;
}

// Numbers are eliminated as long as there are any; what is left is known by its places alone.
std::size_t StructuralMatrix::rank() const {
  StructuralMatrix left = *this;
  std::vector<bool> row_gone(rows_, false), column_gone(columns_, false);
  std::size_t rank = 0;
  while (true) {
    std::size_t row = rows_, column = columns_;
    double best = 0;
    for (std::size_t r = 0; r < rows_; ++r) {
      if (row_gone[r]) continue;
      double largest = 0;
      for (std::size_t c = 0; c < columns_; ++c) largest = std::max(largest, std::abs(left(r, c).number));
      for (std::size_t c = 0; c < columns_; ++c) {
        if (column_gone[c] || left(r, c).is_any || std::abs(left(r, c).number) <= best * largest) continue;
        best = std::abs(left(r, c).number) / largest, row = r, column = c;
      }
    }
    if (row == rows_) break;
    const StructuralEntry pivot = left(row, column);
    for (std::size_t r = 0; r < rows_; ++r) {
      const StructuralEntry head = left(r, column);
      if (row_gone[r] || r == row || head.is_zero()) continue;
      const double factor = head.is_any ? 1 : head.number / pivot.number;
      for (std::size_t c = 0; c < columns_; ++c) {
        if (column_gone[c] || c == column) continue;
        left(r, c) =
            head.is_any && !left(row, c).is_zero() ? StructuralEntry::any() : less(left(r, c), factor, left(row, c));
      }
      left(r, column) = {};
    }
    row_gone[row] = column_gone[column] = true;
    ++rank;
  }
  for (std::size_t r = 0; r < rows_; ++r) {
    for (std::size_t c = 0; c < columns_; ++c) {
      if (row_gone[r] || column_gone[c]) left(r, c) = {};
    }
  }
  std::vector<std::size_t> unused;
  return rank + left.term_rank(unused);
}

}  // namespace dynalin

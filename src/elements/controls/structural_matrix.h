// Matrices of which some entries are known numbers and the others are anything but zero, independent of each other: the
// rank they have for almost all values (mixed matrices, Murota 2000, without the dependence that elimination makes).
#pragma once

#include <cstddef>
#include <vector>

namespace dynalin {

struct StructuralEntry {
  double number = 0;
  bool is_any = false;

  static StructuralEntry any() { return {0, true}; }
  bool is_zero() const { return !is_any && number == 0; }
};

class StructuralMatrix {
 public:
  StructuralMatrix(std::size_t rows, std::size_t columns) : rows_(rows), columns_(columns), entries_(rows * columns) {}
  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  StructuralEntry& operator()(std::size_t r, std::size_t c) { return entries_[r * columns_ + c]; }
  const StructuralEntry& operator()(std::size_t r, std::size_t c) const { return entries_[r * columns_ + c]; }

  StructuralMatrix columns_only(const std::vector<std::size_t>&) const;
  std::size_t rank() const;
  // The rank if nothing but the places of entries counts; `row_of` has the row of each column, rows() for none.
  std::size_t term_rank(std::vector<std::size_t>& row_of) const;

 private:
  std::size_t rows_, columns_;
  std::vector<StructuralEntry> entries_;
};

}  // namespace dynalin

// Sparse LU of the matrices of one integration, which follow each other: all of one pattern, most of them near the one
// before. KLU factors the entries that have been other than zero, or rounding, so far. Most of what the partials of
// elements reserve never is: for links in a plane three quarters.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mechanics/accumulator.h"

namespace dynalin {

class StepFactors {
 public:
  StepFactors();
  ~StepFactors();
  StepFactors(const StepFactors&) = delete;
  StepFactors& operator=(const StepFactors&) = delete;

  // False if a pivot is nothing; there is nothing to solve with then. The pattern is that of the first.
  bool factor(const ColumnMatrix&);
  // In place, without refinement: an iteration corrects what rounding leaves.
  void solve(std::span<double> x);

  std::size_t entries() const;                         // of the factors
  std::int64_t analyses() const { return analyses_; }  // so far

 private:
  bool needs_analysis(const ColumnMatrix&) const;  // entries that count are not among those that are kept
  void analyse(const ColumnMatrix&);
  void put_matched_rows_on_diagonal();

  struct Klu;
  std::unique_ptr<Klu> klu_;
  std::vector<char> kept_;            // by entry of the matrix: whether it counts
  std::vector<std::size_t> entries_;  // those that do
  ColumnMatrix matrix_;               // of them alone, its rows in an order that leaves no zero on the diagonal
  std::vector<std::int32_t> row_;     // of the matrix, by row of this one
  std::vector<double> permuted_;      // right-hand side, scratch
  double growth_ = 0;                 // reciprocal, of the factors whose pivots are in use
  std::int64_t analyses_ = 0;
};

}  // namespace dynalin

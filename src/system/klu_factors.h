// KLU: left-looking LU with a block triangular form, for patterns without loops.
#pragma once

#include <klu.h>

#include "mechanics/accumulator.h"
#include "system/klu_work.h"

namespace dynalin {

class KluFactors {
 public:
  KluFactors() { klu_defaults(&common_); }
  ~KluFactors() {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }
  KluFactors(const KluFactors&) = delete;
  KluFactors& operator=(const KluFactors&) = delete;

  // Of the pattern, once; false if it alone makes the matrix singular.
  bool analyse(ColumnMatrix&);
  double predicted_entries() const { return symbolic_->lnz + symbolic_->unz; }
  // False if a pivot is nothing.
  bool factor(ColumnMatrix&);
  // The smallest pivot beside the largest.
  double least_pivot();
  // The smallest pivot beside the terms Σ |l||u| that were taken from its place: what cancellation has left of it.
  double most_cancelled();
  int determinant_sign() const;  // 1 or −1
  // In place, of columns that follow each other; in several threads at once if need be.
  void solve(double* x, int n, int columns) const {
    work_.with(common_, [&](klu_numeric* f, klu_common* c) { klu_solve(symbolic_, f, n, columns, x, c); });
  }
  void solve_transposed(double* x, int n, int columns) const {
    work_.with(common_, [&](klu_numeric* f, klu_common* c) { klu_tsolve(symbolic_, f, n, columns, x, c); });
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(numeric_->lnz) + static_cast<std::size_t>(numeric_->unz);
  }

 private:
  void throw_if_out_of_memory() const;

  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
  mutable KluWork work_;
};

}  // namespace dynalin

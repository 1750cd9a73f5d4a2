// Sparse LU of S − σ E for a complex shift, E the identity in the last places of the diagonal and zero elsewhere: KLU,
// or MUMPS where loops would fill it in (lu_choice.h).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>

#include "mechanics/accumulator.h"

namespace dynalin {

class ShiftedLu {
 public:
  // The pattern is analysed once; `shifted` is how many of the last diagonal places E has.
  ShiftedLu(const ColumnMatrix& S, std::int32_t shifted);
  ~ShiftedLu();
  ShiftedLu(const ShiftedLu&) = delete;
  ShiftedLu& operator=(const ShiftedLu&) = delete;

  double predicted_entries() const;  // of the factors
  // False if a pivot is exactly zero.
  bool factor(std::complex<double> shift);
  void solve(Eigen::VectorXcd&) const;
  void solve_adjoint(Eigen::VectorXcd&) const;  // (S − σ E)ᴴ
  // log det (S − σ E): its imaginary part to multiples of 2π, and to a constant that all shifts share.
  std::complex<double> log_determinant() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace dynalin

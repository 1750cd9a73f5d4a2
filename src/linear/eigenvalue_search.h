// The search for eigenvalues of the sparse pencil from shifts near them, on one side: right vectors with (A − σ)⁻¹,
// left ones with its adjoint. What was found is kept from shift to shift.
#pragma once

#include "linear/krylov_schur.h"
#include "linear/shift_inverse.h"

namespace dynalin {

class EigenvalueSearch {
 public:
  enum class Side : bool { right, left };

  EigenvalueSearch(ShiftInverse& op, Side side) : op_(&op), side_(side), space_(op.states()) {}

  // The operator has a new shift.
  void follow_shift();
  // From a new start vector: `wanted` more, or all within `radius` of the shift that this vector sees.
  bool run(Eigen::Index wanted, double radius);
  // Where eigenvalues may be, after a single pass: nothing is kept.
  std::vector<std::complex<double>> glance(Eigen::Index values);

  Eigen::Index found() const { return space_.found(); }
  bool everything() const { return space_.everything(); }
  std::vector<std::complex<double>> values() const;    // λ of what was found
  std::vector<std::complex<double>> in_sight() const;  // and of what has not converged
  // How far from the shift the last run has got.
  double reached() const { return reached_; }

  // The invariant subspace of the values that `which` says, in units of the operator, and for right vectors A on it.
  struct Part {
    Eigen::MatrixXcd basis, matrix;
  };
  Part part(const std::function<bool(std::complex<double>)>& which);

 private:
  std::complex<double> shift() const { return side_ == Side::right ? op_->shift() : std::conj(op_->shift()); }
  std::complex<double> value_of(std::complex<double> theta) const {
    const std::complex<double> v = at_ + 1.0 / theta;
    return side_ == Side::right ? v : std::conj(v);
  }

  ShiftInverse* op_;
  Side side_;
  KrylovSchur space_;
  std::complex<double> at_;  // shift of what the space holds
  double reached_ = 0;
};

}  // namespace dynalin

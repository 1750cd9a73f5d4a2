// The search for eigenvalues of the sparse pencil from shifts near them, on one side: right vectors with (A − σ)⁻¹,
// left ones with its adjoint. What was found is kept from shift to shift.
#pragma once

#include "selected_modes/krylov_schur.h"
#include "selected_modes/shift_inverse.h"

namespace dynalin {

// Of a shift: moduli that may be those of zeros, as they come out from there.
inline constexpr double zero_from_a_shift = 1e-6;

class ModeSearch {
 public:
  virtual ~ModeSearch() = default;

  // The operator has a new shift.
  virtual void follow_shift() = 0;
  // From a new start vector: `wanted` more, or all within `radius` of the shift that this vector sees.
  virtual bool run(Eigen::Index wanted, double radius) = 0;
  // Where eigenvalues may be, after a single pass: nothing is kept.
  virtual std::vector<std::complex<double>> glance(Eigen::Index values) = 0;

  virtual Eigen::Index found() const = 0;
  virtual bool everything() const = 0;
  virtual std::vector<std::complex<double>> values() const = 0;    // λ of what was found
  virtual std::vector<std::complex<double>> in_sight() const = 0;  // and of what has not converged
  // How far from the shift the last run has got.
  virtual double reached() const = 0;

  // The invariant subspace of the values that `which` says, in units of the operator, and for right vectors A on it.
  struct Part {
    Eigen::MatrixXcd basis, matrix;
  };
  virtual Part part(const std::function<bool(std::complex<double>)>& which) = 0;
};

class EigenvalueSearch : public ModeSearch {
 public:
  enum class Side : bool { right, left };

  EigenvalueSearch(ShiftInverse& op, Side side, Progress progress = {})
      : op_(&op), side_(side), space_(op.states(), std::move(progress)) {}

  void follow_shift() override;
  bool run(Eigen::Index wanted, double radius) override;
  std::vector<std::complex<double>> glance(Eigen::Index values) override;
  Eigen::Index found() const override { return space_.found(); }
  bool everything() const override { return space_.everything(); }
  std::vector<std::complex<double>> values() const override;
  std::vector<std::complex<double>> in_sight() const override;
  double reached() const override { return reached_; }
  Part part(const std::function<bool(std::complex<double>)>& which) override;

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

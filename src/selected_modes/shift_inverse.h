// (A − σ)⁻¹ as an operator on states, by the factors of the sparse pencil:
//
//     x ↦ the states in (S − σ E)⁻¹ (0; x)
//
// in units in which the states of modes are of like size, so that lengths and angles in vectors of states mean
// something.
#pragma once

#include <optional>

#include "perturbation/perturbation.h"
#include "selected_modes/conservative_model.h"
#include "system/shifted_lu.h"

namespace dynalin {

class ShiftInverse {
 public:
  // A conservative model has real symmetric factors for shifts on the axes, which are a fraction of those of the
  // pencil.
  explicit ShiftInverse(const PerturbationEquations&, std::shared_ptr<const ConservativeModel> = nullptr);

  // False if the shift is an eigenvalue, as far as the factors can tell.
  bool move_to(std::complex<double> shift);
  std::complex<double> shift() const { return shift_; }
  // Balances the operator: what it makes of arbitrary vectors tells the sizes of its rows and columns (Chen and Demmel,
  // Linear Algebra Appl. 309, 2000).
  void find_units();
  const Eigen::VectorXd& units() const { return unit_; }

  Eigen::Index states() const { return unit_.size(); }
  // On columns of vectors in these units.
  void apply(Eigen::Ref<Eigen::MatrixXcd> x) const;
  void apply_adjoint(Eigen::Ref<Eigen::MatrixXcd> y) const;
  ShiftedLu& factors();  // of the pencil, for other shifts meanwhile; move_to() takes them back
  // Those that are in force instead, if any.
  const ConservativeFactors* symmetric() const { return symmetric_ ? &*symmetric_ : nullptr; }

 private:
  void apply_symmetric(Eigen::Ref<Eigen::MatrixXcd> x) const;
  void apply_symmetric_adjoint(Eigen::Ref<Eigen::MatrixXcd> y) const;

  const PerturbationEquations& equations_;
  Eigen::Index unknowns_;
  std::optional<ShiftedLu> lu_;
  std::optional<ConservativeFactors> symmetric_;
  std::complex<double> shift_;
  Eigen::VectorXd unit_;
};

}  // namespace dynalin

// Models whose eigenvalues are those of a symmetric problem: undamped ones in equilibrium at rest,
//
//     (K − ω² M) q + Gᵀ λ = 0     G q = 0     λ = ±√−ω²
//
// of all coordinates, where K and M are symmetric, M is positive for all motions that the constraints leave, and the
// rows of G are independent. K is symmetric in an equilibrium without follower forces, but for rounding.
#pragma once

#include <memory>
#include <vector>

#include "perturbation/perturb.h"
#include "perturbation/perturbed_point.h"
#include "system/symmetric_factors.h"

namespace dynalin {

class ConservativeModel {
 public:
  // Nothing for a model of another kind.
  static std::shared_ptr<const ConservativeModel> make(const Perturbation&);

  Eigen::Index coordinates() const { return coordinates_; }
  Eigen::Index rows() const { return rows_; }  // of G
  Eigen::Index freedoms() const { return coordinates_ - rows_; }
  const PerturbationEquations& equations() const { return equations_; }

  Eigen::MatrixXd forces(const Eigen::MatrixXd& accelerations) const;  // M a
  // Positions among the states of columns of coordinates, rates zero; and its transpose.
  Eigen::MatrixXd states_of(const Eigen::MatrixXd& coordinates) const;
  Eigen::MatrixXd states_transposed(const Eigen::MatrixXd& of_states) const;
  // What positions among the states do to all coordinates; and its transpose.
  Eigen::MatrixXcd motions(const Eigen::MatrixXcd& of_states) const;
  Eigen::MatrixXd motions_transposed(const Eigen::MatrixXd& of_coordinates) const;
  // Where the position and its rate stand in the list of states.
  const std::vector<std::int32_t>& positions() const { return choice_.position_state; }
  const std::vector<std::int32_t>& rates() const { return choice_.rate_state; }

  // The lower triangle of [K Gᵀ; G 0], and M in the same pattern.
  const ColumnMatrix& stiffness() const { return stiffness_; }
  const std::vector<double>& mass() const { return mass_; }

 private:
  explicit ConservativeModel(const Perturbation&);
  bool has_positive_mass() const;

  std::shared_ptr<const PerturbedPoint> at_;
  std::shared_ptr<const PerturbationEquations> owner_;
  const PerturbationEquations& equations_;
  const StateChoice& choice_;
  Eigen::Index coordinates_, rows_ = 0;
  ColumnMatrix stiffness_;
  std::vector<double> mass_;
  ColumnMatrix of_accelerations_;  // M as the equations have it, all of it, without zeros
};

// Factors of [K − σM Gᵀ; G 0].
class ConservativeFactors {
 public:
  ConservativeFactors(std::shared_ptr<const ConservativeModel> model, FactorsFor use)
      : model_(std::move(model)), factors_(model_->stiffness(), use) {}

  const ConservativeModel& model() const { return *model_; }
  bool factor(double sigma);
  double sigma() const { return sigma_; }
  // As many modes have ω² < σ; of factors for inertia.
  Eigen::Index below() const { return factors_.negative_pivots() - model_->rows(); }
  // Coordinates of columns of forces: the constraints hold.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& forces) const;

 private:
  std::shared_ptr<const ConservativeModel> model_;
  SymmetricFactors factors_;
  double sigma_ = 0;
};

}  // namespace dynalin

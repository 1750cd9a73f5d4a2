// Residuals of eigenpairs on the sparse perturbation equations, in long double.
#pragma once

#include <Eigen/Core>
#include <complex>

#include "eigenvalues/zero_modes.h"
#include "perturbation/perturbation.h"

namespace dynalin {

constexpr double long_eps = 5.5e-20;      // rounding of one operation in long double
constexpr double first_order_margin = 2;  // a bound that is good to first order leaves as much for the rest

// (S − λ E) w, E the identity in the last `states` places, and what the sums of its rows may have rounded.
struct PencilResidual {
  Eigen::VectorXcd value;
  Eigen::VectorXd rounding;
};

// The pencil with what is zero by the structure of the model exactly so.
//
// The zero modes T₀ leave S W₀ − E W₀ N = R, the rounding of the entries of S. The pencil S − R T₀⁺ is the nearest that
// has them: a mode that runs far along them, as a slow one does beside rigid-body motion, is not driven by R.
class StructuredPencil {
 public:
  // `uncertainty` is what the entries of the state matrix may be off before anything is computed from them,
  // `beside_coefficients` the part of it that does not come of roundings of coefficients, without entries if there is
  // none.
  StructuredPencil(const PerturbationEquations&, const ZeroModes&, const Eigen::MatrixXd& uncertainty,
                   const Eigen::MatrixXd& beside_coefficients);

  const PerturbationEquations& equations() const { return equations_; }
  PencilResidual residual(std::complex<long double> lambda, const Eigen::VectorXcd& w) const;
  // (S − λ E)ᴴ y.
  Eigen::VectorXcd left_residual(std::complex<long double> lambda, const Eigen::VectorXcd& y) const;
  // R T₀⁺ of the states in w: what the pencil as assembled would add.
  Eigen::VectorXcd taken_out(const Eigen::VectorXcd& w) const;
  // R of the zero modes, and T₀⁺.
  const Eigen::MatrixXd& zero_residuals() const { return residuals_; }
  const Eigen::MatrixXd& zero_shares() const { return shares_; }
  const Eigen::MatrixXd& uncertainty() const { return uncertainty_; }
  const Eigen::MatrixXd& beside_coefficients() const { return beside_coefficients_; }

 private:
  PencilResidual as_assembled(std::complex<long double> lambda, const Eigen::VectorXcd& w) const;

  const PerturbationEquations& equations_;
  const Eigen::MatrixXd &uncertainty_, &beside_coefficients_;
  ColumnMatrix rows_;  // Sᵀ: a row's sum stays in the registers of long double
  Eigen::MatrixXd residuals_, shares_;
};

}  // namespace dynalin

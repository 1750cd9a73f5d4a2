// Residuals of eigenpairs on the sparse perturbation equations, in long double.
#pragma once

#include <Eigen/Core>
#include <complex>

#include "mechanics/accumulator.h"

namespace dynalin {

constexpr double long_eps = 5.5e-20;  // rounding of one operation in long double

// (S − λ E) w, E the identity in the last `states` places, and what the sums of its rows may have rounded.
struct PencilResidual {
  Eigen::VectorXcd value;
  Eigen::VectorXd rounding;
};
PencilResidual pencil_residual(const ColumnMatrix& S, std::int32_t states, std::complex<long double> lambda,
                               const Eigen::VectorXcd& w);

}  // namespace dynalin

// What backward errors ‖A x − λ x‖/‖A‖ are made of, without the state matrix A.
#pragma once

#include "perturbation/perturbation.h"

namespace dynalin {

// Frobenius' norm, of a model with many states an estimate.
double norm_of_state_matrix(const PerturbationEquations&);

// ‖A v‖ of columns v, one by one.
Eigen::VectorXd sizes_of_images(const PerturbationEquations&, const Eigen::MatrixXd& v);

}  // namespace dynalin

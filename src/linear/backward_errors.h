// ‖A x − λ x‖/‖A‖ of modes of unit length, without the state matrix A.
#pragma once

#include "linear/eigen.h"
#include "linear/perturbation.h"

namespace dynalin {

// Of all modes with vectors. ‖A‖ is Frobenius' norm, of a model with many states an estimate.
void add_backward_errors(const PerturbationEquations&, EigenSolution&);

}  // namespace dynalin

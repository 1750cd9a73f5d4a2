// Eigenvalues of a state matrix, in the order in which they are printed, with a statement of how good each one is.
#pragma once

#include "analysis/initial.h"
#include "linear/linear_system.h"

namespace dynalin {

// With `right`, eigenvectors, condition numbers and error bounds.
enum class Vectors : bool { none, right };

// λ/2π: real ones first by ascending modulus, then complex pairs by ascending imaginary part. Zeros that follow from
// the structure are exact (zero_modes.h); with vectors, the others are corrected on the sparse perturbation equations
// and carry an error bound (eigen_refinement.h).
Result<EigenSolution> eigensolve(const LinearSystem&, Vectors = Vectors::right);

}  // namespace dynalin

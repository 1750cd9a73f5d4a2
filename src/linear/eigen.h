// Eigenvalues of a state matrix, in the order in which they are printed.
#pragma once

#include "analysis/initial.h"
#include "linear/linear_system.h"

namespace dynalin {

// With `right`, eigenvectors and, from the left ones, the condition number of each eigenvalue.
enum class Vectors : bool { none, right };

// λ/2π: real ones first by ascending modulus, then complex pairs by ascending imaginary part.
Result<EigenSolution> eigensolve(const LinearSystem&, Vectors = Vectors::right);

}  // namespace dynalin

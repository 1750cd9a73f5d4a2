// Equal eigenvalues of equal parts: the QR iteration gives each a vector of its own, and left and right ones of these
// need not be dual to each other; they may come out next to parallel, as if the eigenvalue were defective.
#pragma once

#include "eigenvalues/eigen_pairs.h"
#include "perturbation/perturbation.h"

namespace dynalin {

// Gives eigenvalues that are equal but for rounding, and whose left and right vectors are not dual, an orthonormal
// basis of their invariant subspace, with the dual one on the left. Vectors of defective eigenvalues stay as they are.
void separate_equal_values(const PerturbationEquations&, EigenPairs&);

}  // namespace dynalin

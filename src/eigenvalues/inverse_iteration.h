// Single eigenvalues that are inexact against their own modulus, refined on the sparse perturbation equations.
#pragma once

#include "eigenvalues/eigen_pairs.h"
#include "eigenvalues/pencil_residual.h"

namespace dynalin {

// One step of inverse iteration, and then Newton corrections of value and vectors by residuals in long double, for the
// pairs `wanted`, smallest modulus first; nothing where the factors would be large. A result farther away than the
// pair's bound, or no better, is not taken, nor one whose vectors do not converge.
void refine_by_inverse_iteration(const StructuredPencil&, std::vector<Eigen::Index> wanted, EigenPairs& pairs,
                                 std::vector<EigenTrust>& trust);

}  // namespace dynalin

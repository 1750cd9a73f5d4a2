// Eigenvalues of a state matrix, in the order in which they are printed, with a statement of how good each one is.
#pragma once

#include <optional>

#include "analysis/initial.h"
#include "base/progress.h"
#include "eigenvalues/eigen_pairs.h"
#include "eigenvalues/zero_modes.h"
#include "linear/linear_system.h"

namespace dynalin {

// What the solution holds of eigenvectors; values and bounds need them all the same.
enum class Vectors : bool { none, right };

// λ/2π: real ones first by ascending modulus, then complex pairs by ascending imaginary part. Zeros that follow from
// the structure are exact (zero_modes.h); the others are corrected on the sparse perturbation equations and carry an
// error bound (eigen_refinement.h).
Result<EigenSolution> eigensolve(const LinearSystem&, Vectors = Vectors::right, const Progress& = {});

// What the QR iteration alone gives of a finite state matrix [rad/time], and the zeros that it did not see; nothing if
// it does not converge.
struct UnrefinedPairs {
  ZeroModes zero;
  EigenPairs pairs;
};
std::optional<UnrefinedPairs> unrefined_pairs(const LinearSystem&);

}  // namespace dynalin

// Eigenvalues of a computed invariant subspace with vectors and bounds: clusters of its Schur form as directions, their
// small matrix on the sparse equations (subspace_pencil.h), discs that certainly hold its eigenvalues (inclusion.h).
#pragma once

#include <optional>

#include "eigenvalues/eigen_pairs.h"
#include "selected_modes/near_zero.h"
#include "selected_modes/shift_inverse.h"

namespace dynalin {

// In units of the operator: A Q = Q B, Aᴴ P = P (…), both orthonormal and of the same eigenvalues.
struct TwoSided {
  Eigen::MatrixXcd Q, B, P;
  bool both_members = false;  // of every pair of eigenvalues
};

struct BoundedPairs {
  EigenPairs pairs;  // those with Im ≥ 0; right and left vectors of states, unit length
  std::vector<EigenTrust> trust;
  std::vector<double> residual;  // ‖A x − λ x‖ of each
};

// `zero` are structural zeros in the subspace; `distance` is that of other eigenvalues of the model from those of the
// subspace. Nothing if left and right vectors do not belong together, or bounds contradict each other.
std::optional<BoundedPairs> bounded_pairs(const PerturbationEquations&, const ShiftInverse&, TwoSided,
                                          const NearZero& zero, double distance);

// The same of right vectors alone, A Q = Q B, where the left ones do not agree with them: nothing bounds the values.
BoundedPairs pairs_without_bounds(const ShiftInverse&, const Eigen::MatrixXcd& Q, const Eigen::MatrixXcd& B);

}  // namespace dynalin

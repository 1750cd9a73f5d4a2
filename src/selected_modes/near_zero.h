// Structural zeros (structural_zeros.h) in a computed invariant subspace near zero: the cost is that of its few
// directions, not of all states.
#pragma once

#include <Eigen/Core>

#include "linear/linear_system.h"

namespace dynalin {

struct NearZero {
  Eigen::MatrixXd directions;  // V: columns of states, A V = V N
  Eigen::MatrixXd chains;      // N, strictly upper triangular but for rounding

  Eigen::Index count() const { return directions.cols(); }
  bool defective() const { return !chains.isZero(0); }
  // Eigenvectors of A, unit vectors, one for each zero: the last link of the chain it belongs to.
  Eigen::MatrixXd vectors() const;
};

// Where the state matrix is affordable: all that eigensolve() finds (zero_modes.h).
NearZero all_structural_zeros(const LinearSystem&);

// `basis` holds the invariant subspace in columns of states that are orthonormal in `units`.
NearZero structural_zeros_near(const System&, const Perturbation&, const Eigen::MatrixXcd& basis,
                               const Eigen::VectorXd& units);

}  // namespace dynalin

// Discs that certainly hold the eigenvalues of a matrix whose entries are known to within given amounts, however
// defective: each disc with the number of eigenvalues in it, all discs apart from each other.
//
// With a basis Z of invariant subspaces as nearly as long double has them, Z⁻¹ M Z = diag(D_i) + E, and |E| is bounded
// block by block, roundings of this very product included. If z is an eigenvalue and x_i ≠ 0 its part in block i, then
// (z − D_j) x_j = Σ_l E_jl x_l for the others bounds |x_j| by w_j |x_i|, w being any w ≥ (|E_ji| + Σ_l |E_jl| w_l)/s_j,
// s_j ≤ σ_min(z − D_j); and σ_min(z − D_i) ≤ τ_i = |E_ii| + Σ_j |E_ij| w_j. Where that fails on all of a circle no
// eigenvalue is on it, for none of the matrices diag(D) + t E between: inside are as many as D_i has.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace dynalin {

using LongComplexMatrix = Eigen::Matrix<std::complex<long double>, Eigen::Dynamic, Eigen::Dynamic>;

struct InclusionDisc {
  std::complex<double> centre;
  double radius = 0;
  double tau = 0;          // what the block is known to within
  Eigen::Index count = 0;  // of eigenvalues inside
  // Unit vectors, one column for each of them; where there are fewer directions than eigenvalues, some repeat.
  Eigen::MatrixXcd right, left;
  Eigen::MatrixXcd basis, dual;  // of the invariant subspace, and what is dual to it: dualᴴ basis = 1
  std::vector<double> powers;    // |(D − centre)^l|, l = 0 … count, rounding included

  double radius_under(double change) const;  // of a block that is known to within `change` only
};

// Of a real matrix the discs on and above the real axis: those below are their mirror images; a disc on the axis has
// its centre there, and a single eigenvalue in it is real. Nothing if the QR iteration does not converge.
std::optional<std::vector<InclusionDisc>> inclusion_discs(const LongComplexMatrix& M,
                                                          const Eigen::MatrixXd& uncertainty, bool real);

}  // namespace dynalin

// What the sparse perturbation equations make of a few directions: the small matrix that has the eigenvalues of an
// invariant subspace, its entries corrected to long double and each with what it may be off.
//
// X and Y are computed bases of the right and left subspace, Yᴴ X = 1, V those of structural zeros in it with
// A V = V N. With the residuals R = A X − X B − V C and L = Aᴴ Y − Y Bᴴ, and the complement of X and V,
//
//     A ~ ⎡ B + Yᴴ R   Lᴴ  ⎤          eigenvalues near z are those of  B + Yᴴ R + Lᴴ (z − A_c)⁻¹ R.
//         ⎣    R       A_c ⎦
//
// Both factors of the last term are the rounding of the subspace: its size is estimated by the operator (A_c − σ)⁻¹.
#pragma once

#include "eigenvalues/inclusion.h"
#include "eigenvalues/pencil_residual.h"
#include "selected_modes/shift_inverse.h"

namespace dynalin {

struct Subspace {
  Eigen::MatrixXcd X, Y, B;  // of states
  Eigen::MatrixXd V, N;      // structural zeros, no columns if there are none
  Eigen::MatrixXcd C;
};

struct SubspacePencil {
  LongComplexMatrix value;  // B + Yᴴ R
  Eigen::MatrixXd uncertainty;
  Eigen::MatrixXd unknown;    // the part of it that no better computation takes away
  Eigen::MatrixXcd residual;  // R
};

// `distance` is how far eigenvalues of the subspace are from all others, at least, `reach` how far from the shift of
// the operator, at most.
SubspacePencil measured(const PerturbationEquations&, const ShiftInverse&, const Subspace&, double distance,
                        double reach);

}  // namespace dynalin

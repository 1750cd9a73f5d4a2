// Correction of computed eigenvalues on the sparse perturbation equations, and how far each may still be off.
//
// With all eigenvectors X = [x_j] and Y their left counterparts, R the residuals S w − λ E w of the sparse pencil
// (perturbation.h) in long double, reduced to the states, the similar matrix
//
//     X⁻¹ A X = Λ + G,   G_ij = y_iᴴ r_j / y_iᴴ x_i  (minus what Yᴴ X is off from diagonal)
//
// is exact. G_ii is what the two-sided Rayleigh quotient adds to λ_i; what is left of second order,
// Σ_j (|G_ij|/|λ_i − λ_j| + |p_ij|) |G_ji|, bounds the error of an isolated eigenvalue, the norm of its block of G that
// of one in a cluster (Gershgorin, Bauer and Fike; Stewart and Sun, Matrix Perturbation Theory, IV). Eigenvalues for
// which that is not small against their modulus are refined by inverse iteration on the pencil.
#pragma once

#include <vector>

#include "linear/perturbation.h"
#include "linear/zero_modes.h"

namespace dynalin {

// Computed pairs in rad per time: of each complex pair the one with positive imaginary part.
struct EigenPairs {
  std::vector<std::complex<double>> values;
  Eigen::MatrixXcd right, left;  // one column each
};

struct EigenTrust {
  double bound = 0;      // |error| of the value as corrected [rad/time]
  bool refined = false;  // by inverse iteration
};

// Corrects `pairs` in place. The zero modes are those split off before.
std::vector<EigenTrust> refine(const PerturbationEquations&, const ZeroModes&, EigenPairs& pairs);

}  // namespace dynalin

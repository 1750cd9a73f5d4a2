// How close to a block D of a nearly block diagonal matrix its eigenvalues are, from the powers of N = D − c, c its
// mean: those of a defective block vanish soon.
#pragma once

#include <vector>

#include "eigenvalues/inclusion.h"
#include "eigenvalues/pencil_residual.h"
#include "eigenvalues/rounding.h"

namespace dynalin {

constexpr double least_size = 1e-300;  // keeps strict inequalities strict

Eigen::MatrixXd sizes(const LongComplexMatrix&);
// Of a sum of products of complex numbers, n of them, in units of Σ|a||b|.
inline double rounding_of_sum(Eigen::Index n) { return 2 * static_cast<double>(n + 4) * long_eps; }

// Bounds of |N^l| in the Frobenius norm, l = 0 … k; that of the first is the 2-norm.
std::vector<double> power_norms(const LongComplexMatrix& N);
// A bound of |(ζ − N)⁻¹|, |ζ| = distance, by Σ_l |N^l|/|ζ|^(l+1) / (1 − |N^k|/|ζ|^k).
double resolvent_bound(const std::vector<double>& powers, double distance);
// The smallest circle around the centre of a block on which |(z − D)⁻¹| tau < 1.
double smallest_radius(const std::vector<double>& powers, double tau);

}  // namespace dynalin

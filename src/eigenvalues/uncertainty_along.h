// What is not known of the state matrix, along left and right vectors.
//
// For any δA within U entry by entry, |yᴴ δA x| ≤ |y|ᵀ U |x|. But a coefficient of the equations that rounding has
// moved moves many entries of A at once: with y and x completed to all unknowns of the sparse pencil it makes y_r ρ_rc
// x_c, and all of them √Σ(|y_r| ρ_rc |x_c|)², which is never more. Where masses couple soft motions with stiff ones, as
// of a flexible body with shapes far above all others, entries of A cancel along a soft mode, and U says nothing of it.
#pragma once

#include "eigenvalues/eigen_pairs.h"
#include "eigenvalues/pencil_residual.h"

namespace dynalin {

// |y_iᴴ δA x_j|, at most, of all pairs.
Eigen::MatrixXd uncertainty_along(const StructuredPencil&, const EigenPairs&);
// The same of one, y and x of all unknowns of the pencil.
double uncertainty_along(const StructuredPencil&, const Eigen::VectorXcd& y, const Eigen::VectorXcd& x);

}  // namespace dynalin

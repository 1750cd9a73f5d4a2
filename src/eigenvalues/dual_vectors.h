// Left vectors that are dual to the right ones, where the QR iteration has given others: of badly scaled matrices, one
// that is next to orthogonal to its own right vector may be so to none of the others.
#pragma once

#include "eigenvalues/eigen_pairs.h"

namespace dynalin {

// The pairs with left vectors in the same space as theirs and y_iᴴ x_j next to nothing beside y_iᴴ x_i; as they are
// where that is so already, or where the right ones are no basis.
EigenPairs with_dual_vectors(EigenPairs);

}  // namespace dynalin

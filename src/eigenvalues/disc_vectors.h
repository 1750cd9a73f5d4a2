// Vectors for the eigenvalues that a disc holds.
#pragma once

#include "eigenvalues/inclusion.h"

namespace dynalin {

// Fills in the unit vectors that D − c shrinks most, to the right and to the left, D the block of M that belongs to the
// basis and the dual of the disc, c its centre. Equal eigenvalues take the basis and its dual as they are. M is
// balanced by `scale`, the vectors that come of it are not; on the real axis they are real.
void add_vectors(const LongComplexMatrix& M, const Eigen::VectorXd& scale, bool on_axis, InclusionDisc&);

}  // namespace dynalin

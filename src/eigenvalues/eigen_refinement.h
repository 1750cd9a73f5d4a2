// Correction of computed eigenvalues on the sparse perturbation equations, and how far each may still be off: residuals
// in components along all modes (eigen_residuals.h) correct eigenvalues that lie apart (isolated_values.h), a second
// time from vectors improved to first order where the first has left anything; where that proves nothing, clusters of
// defective eigenvalues are bounded together (included_values.h). Single ones that are still inexact against their
// modulus are refined by inverse iteration (inverse_iteration.h).
#pragma once

#include "eigenvalues/eigen_pairs.h"
#include "eigenvalues/pencil_residual.h"
#include "eigenvalues/zero_modes.h"

namespace dynalin {

// Corrects `pairs` in place. The zero modes are those split off before; the bounds hold for all state matrices that the
// uncertainty of the pencil leaves open.
std::vector<EigenTrust> refine(const StructuredPencil&, const ZeroModes&, EigenPairs& pairs);

}  // namespace dynalin

// Modes near a point or in a band, on the sparse perturbation equations: nothing dense of the size of the model, and a
// count that shows whether one is missing.
#pragma once

#include "eigenvalues/eigen.h"
#include "linear/linear_system.h"

namespace dynalin {

// The same order, values, vectors, bounds and condition numbers as eigensolve() has for these modes.
Result<EigenSolution> eigensolve_selected(const System&, const Perturbation&, const ModeSelection&,
                                          Vectors = Vectors::right, const Progress& = {});

}  // namespace dynalin

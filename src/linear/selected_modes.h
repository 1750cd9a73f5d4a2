// Modes near a point or in a band, on the sparse perturbation equations: nothing dense of the size of the model, and a
// count that shows whether one is missing.
#pragma once

#include "linear/eigen.h"
#include "linear/linear_system.h"

namespace dynalin {

// The same order, values, vectors, bounds and condition numbers as eigensolve() has for these modes.
Result<EigenSolution> eigensolve_selected(const System&, const Perturbation&, const ModeSelection&,
                                          Vectors = Vectors::right);

// The same out of all modes, where they are known.
EigenSolution selected_of(const EigenSolution& all, const ModeSelection&);
// Those that are no structural zeros.
std::size_t modes_in(const EigenSolution&);
// Of what selects the nearest modes: without those that are farther than as many as are asked for. Values that bounds
// have made one, as a double one on the real axis that looked like a pair, are as many as they are.
EigenSolution without_farther_ones(EigenSolution selected);

}  // namespace dynalin

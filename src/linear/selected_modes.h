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

// Whether the bounds of one leave open on which side of the border of a band it is.
bool may_be_beyond_band(const ModesInBand&, const std::vector<EigenMode>&);
inline constexpr const char* beyond_band = "bounds do not tell whether one at the border is inside";

}  // namespace dynalin

// What a reduction has come to, as text.
#pragma once

#include <iosfwd>

#include "reduction/body_file.h"
#include "reduction/craig_bampton.h"

namespace dynalin::reduction {

// Freedoms, modes, frequencies, mass and inertia, in the units of the finite-element model.
void print_report(std::ostream&, const FiniteElementModel&, const ReductionRequest&, const Reduction&);

}  // namespace dynalin::reduction

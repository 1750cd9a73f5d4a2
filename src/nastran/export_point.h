// The linear model that an export is made of.
#pragma once

#include "nastran/export_options.h"
#include "study/linearization.h"

namespace dynalin::nastran {

// That of the linearization, or of the same point again where the options want damping otherwise.
StudyResult<Linearization> linearization_for(const Linearization&, const ExportOptions&);

// Whether velocities or accelerations are more than rounding, so that a deck of forces alone is not the linear model.
bool moves(const Linearization&);

}  // namespace dynalin::nastran

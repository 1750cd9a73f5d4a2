// The perturbation equations that an export is made of.
#pragma once

#include "nastran/export_options.h"
#include "study/linearization.h"

namespace dynalin::nastran {

// Those of the linearization, or the same point again where the options want damping otherwise.
StudyResult<Perturbation> perturbation_for(const Linearization&, const ExportOptions&);

}  // namespace dynalin::nastran

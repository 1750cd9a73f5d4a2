// Which constraints contradict each other: a row whose gradient follows from those of others, and whose value does not.
#pragma once

#include <string>
#include <vector>

#include "system/elimination.h"
#include "system/system.h"

namespace dynalin {

// Of constraint rows what displacements make of them, in lengths of the model and radians.
std::vector<SparseRow> scaled_gradients(const System&, const ConstraintRows&);

// "φ in MOTION/2 cannot hold together with MOTION/1": the row and the elements whose rows make up its gradient, out of
// those that are active.
std::string contradiction(const System&, const std::vector<SparseRow>& gradients, const std::vector<bool>& active,
                          std::int32_t row);

}  // namespace dynalin

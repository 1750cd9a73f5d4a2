// Coordinates that a PSTATE states: smooth functions of positions and time. VARIABLEs inside them count with their own
// expressions.
#pragma once

#include "elements/controls/variable_list.h"
#include "states/candidates.h"

namespace dynalin {

// Appends them to `own`, in the order of the list, with their gradients along the motion from `row` on.
std::optional<Failure> add_user_candidates(const System&, const Motion&, const VariableList&, std::int32_t row,
                                           CandidateSet&);

}  // namespace dynalin

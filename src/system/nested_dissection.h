// An order of the unknowns of a sparse matrix in which elimination fills in little: nested dissection by METIS of what
// the matrix connects.
//
// Unknowns with the same neighbours, as the coordinates of a body, are one vertex of the graph. Those that do not enter
// their own equation, as multipliers of constraints, have no pivot before a neighbour of theirs is eliminated: they
// stand right behind one of them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mechanics/accumulator.h"

namespace dynalin {

// The place of each unknown in the order, from 0 on; nothing for a pattern that is not symmetric.
std::optional<std::vector<std::int32_t>> nested_dissection(const ColumnMatrix&);

}  // namespace dynalin

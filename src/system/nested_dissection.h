// An order of the unknowns of a sparse matrix in which elimination fills in little: nested dissection by METIS of what
// the matrix connects.
//
// Unknowns with the same neighbours, as the coordinates of a body or the multipliers of a joint, are one vertex of the
// graph. Unknowns that do not enter their own equation, as multipliers, have no pivot before a neighbour of theirs is
// eliminated. Bodies that are connected by nothing but multipliers are therefore no vertices: each comes right before
// the first of its multipliers, which are connected through it. A multiplier between others stands behind one of them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mechanics/accumulator.h"

namespace dynalin {

// The place of each unknown in the order, from 0 on; nothing for a pattern that is not symmetric.
std::optional<std::vector<std::int32_t>> nested_dissection(const ColumnMatrix&);

}  // namespace dynalin

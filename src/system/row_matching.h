// A row for each column of a square matrix, such that the entries at these places are in its pattern: what an ordering
// for sparse elimination begins with where diagonals are zero.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/accumulator.h"

namespace dynalin {

// By column. Entries that are large in their column, rows in units of their largest entry, are taken where that can be,
// diagonals first; else those that are small or zero. A matrix that is singular by its pattern alone has as
// many pairs as it can, and the rows that are left in any order.
std::vector<std::int32_t> matched_rows(const ColumnMatrix&);

// The rows of all entries with the matched one first in its column. There KLU's analysis finds it without a search of
// its own, which may go through the whole model for each column: n² steps for the equations of a chain.
std::vector<std::int32_t> rows_with_matched_first(const ColumnMatrix&);

// What KLU's analysis is given: those of large models; small ones as they are, whose search costs nothing.
std::vector<std::int32_t> rows_for_analysis(const ColumnMatrix&);

}  // namespace dynalin

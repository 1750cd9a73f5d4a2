// Rank-revealing elimination of constraint rows with preferred pivot columns.
//
// Columns are offered as pivots in a given order, the least wanted states first. A column becomes dependent where
// some row of the remaining system has an entry of at least τ times the largest of that row; of such rows the one whose
// columns end soonest in the order is taken. Rows that vanish are redundant, columns that never gave a pivot are
// independent: one elimination answers both questions, and dependent coordinates are combinations of the independent
// ones with factors of at most 1/τ a step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mechanics/sparse_row.h"

namespace dynalin {

struct EliminationOptions {
  double pivot_threshold = 0.1;  // τ
  double rank_tolerance = 1e-9;  // a row is zero below this fraction of its first size
};

struct Elimination {
  std::vector<std::int32_t> pivot_column;  // of each row, −1 for a redundant one
  std::vector<bool> dependent;             // of each column
  double largest_dropped = 0;              // of rows that depend on others: what was left, against the first size
  std::size_t rank = 0;
};

// `order` lists every column once. Values are expected in comparable units (lengths divided by a model length).
Elimination eliminate(std::vector<SparseRow> rows, std::int32_t columns, std::span<const std::int32_t> order,
                      const EliminationOptions& = {});

}  // namespace dynalin

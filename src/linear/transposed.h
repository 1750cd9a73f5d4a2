// The transpose of a sparse matrix: its columns are the rows.
#pragma once

#include <vector>

#include "system/sparse_lu.h"

namespace dynalin {

inline ColumnMatrix transposed(const ColumnMatrix& m) {
  std::vector<Triplet> entries;
  entries.reserve(m.value.size());
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({c, r, v}); });
  return compressed(m.columns, m.rows, entries);
}

}  // namespace dynalin

// The transpose of a sparse matrix: its columns are the rows.
#pragma once

#include <vector>

#include "mechanics/accumulator.h"

namespace dynalin {

inline ColumnMatrix transposed(const ColumnMatrix& m) {
  ColumnMatrix t{.rows = m.columns, .columns = m.rows, .start = {}, .row = {}, .value = {}};
  t.start.assign(static_cast<std::size_t>(m.rows) + 1, 0);
  for (const std::int32_t r : m.row) ++t.start[static_cast<std::size_t>(r) + 1];
  for (std::size_t r = 1; r < t.start.size(); ++r) t.start[r] += t.start[r - 1];
  t.row.resize(m.row.size()), t.value.resize(m.row.size());
  std::vector<std::int32_t> next(t.start.begin(), t.start.end() - 1);
  for_each_entry(m, [&](std::int32_t r, std::int32_t c, double v) {
    const auto k = static_cast<std::size_t>(next[static_cast<std::size_t>(r)]++);
    t.row[k] = c, t.value[k] = v;
  });
  return t;
}

}  // namespace dynalin

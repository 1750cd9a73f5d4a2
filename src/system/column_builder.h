// Compressed columns straight from what gives the entries, for matrices so large that a list of triplets beside them
// would count.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "mechanics/accumulator.h"

namespace dynalin {

// `give(take)` is called twice and calls take(row, column, value) for every entry, the same ones both times; equal
// places are added up in that order, zeros stay.
template <class Give>
ColumnMatrix compressed_columns(std::int32_t rows, std::int32_t columns, Give&& give) {
  const auto at = [](std::int32_t k) { return static_cast<std::size_t>(k); };
  ColumnMatrix m;
  m.rows = rows, m.columns = columns;
  m.start.assign(at(columns) + 1, 0);
  give([&](std::int32_t, std::int32_t c, double) { ++m.start[at(c) + 1]; });
  for (std::size_t c = 0; c < at(columns); ++c) m.start[c + 1] += m.start[c];
  m.row.resize(at(m.start.back()));
  m.value.resize(m.row.size());
  std::vector<std::int32_t> next(m.start.begin(), m.start.end() - 1);
  give([&](std::int32_t r, std::int32_t c, double v) {
    const std::size_t k = at(next[at(c)]++);
    m.row[k] = r, m.value[k] = v;
  });
  std::vector<std::pair<std::int32_t, double>> column;
  std::size_t kept = 0;
  for (std::size_t c = 0; c < at(columns); ++c) {
    column.clear();
    for (std::size_t k = at(m.start[c]); k < at(m.start[c + 1]); ++k) column.emplace_back(m.row[k], m.value[k]);
    std::stable_sort(column.begin(), column.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const std::size_t first = kept;
    m.start[c] = static_cast<std::int32_t>(first);
    for (const auto& [r, v] : column) {
      if (kept > first && m.row[kept - 1] == r) {
        m.value[kept - 1] += v;
      } else {
        m.row[kept] = r, m.value[kept++] = v;
      }
    }
  }
  m.start.back() = static_cast<std::int32_t>(kept);
  m.row.resize(kept), m.value.resize(kept);
  return m;
}

}  // namespace dynalin

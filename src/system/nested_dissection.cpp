#include "system/nested_dissection.h"

#include <metis.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <numeric>
#include <span>

namespace dynalin {

namespace {

std::size_t at(std::int32_t k) { return static_cast<std::size_t>(k); }

std::span<const std::int32_t> rows_of(const ColumnMatrix& m, std::int32_t column) {
  return {m.row.data() + m.start[at(column)], m.row.data() + m.start[at(column) + 1]};
}

bool has_symmetric_pattern(const ColumnMatrix& m) {
  if (m.rows != m.columns) return false;
  // Going through the columns in order meets the entries of each row in order: they must be those of its column.
  std::vector<std::int32_t> next(m.start.begin(), m.start.end() - 1);
  for (std::int32_t c = 0; c < m.columns; ++c) {
    for (const std::int32_t r : rows_of(m, c)) {
      std::int32_t& k = next[at(r)];
      if (k == m.start[at(r) + 1] || m.row[at(k)] != c) return false;
      ++k;
    }
  }
  return true;
}

bool has_pivot(const ColumnMatrix& m, std::int32_t k) {
  const auto rows = rows_of(m, k);
  return std::binary_search(rows.begin(), rows.end(), k);
}

// The unknowns of each vertex, those with a pivot of their own first.
using Vertices = std::vector<std::vector<std::int32_t>>;
struct Gathered {
  Vertices members;
  std::vector<std::int32_t> vertex;  // of each unknown
};

Gathered gather(const ColumnMatrix& m) {
  Gathered g;
  g.vertex.assign(at(m.columns), -1);
  const auto put = [&](std::int32_t k, std::int32_t vertex) {
    g.vertex[at(k)] = vertex;
    g.members[at(vertex)].push_back(k);
  };
  const auto new_vertex = [&] {
    g.members.emplace_back();
    return static_cast<std::int32_t>(g.members.size()) - 1;
  };
  for (std::int32_t k = 0; k < m.columns; ++k) {
    if (g.vertex[at(k)] >= 0 || !has_pivot(m, k)) continue;
    const auto own = rows_of(m, k);
    const std::int32_t vertex = new_vertex();
    put(k, vertex);
    for (const std::int32_t other : own) {
      const auto rows = rows_of(m, other);
      if (g.vertex[at(other)] < 0 && std::equal(own.begin(), own.end(), rows.begin(), rows.end())) put(other, vertex);
    }
  }
  // Behind the neighbour with the fewest members.
  for (std::int32_t k = 0; k < m.columns; ++k) {
    if (g.vertex[at(k)] >= 0) continue;
    std::int32_t best = -1;
    for (const std::int32_t other : rows_of(m, k)) {
      const std::int32_t v = has_pivot(m, other) ? g.vertex[at(other)] : -1;
      if (v >= 0 && (best < 0 || g.members[at(v)].size() < g.members[at(best)].size())) best = v;
    }
    put(k, best >= 0 ? best : new_vertex());
  }
  return g;
}

}  // namespace

std::optional<std::vector<std::int32_t>> nested_dissection(const ColumnMatrix& m) {
  if (m.columns == 0 || !has_symmetric_pattern(m)) return std::nullopt;
  const Gathered g = gather(m);
  auto count = static_cast<idx_t>(g.members.size());
  std::vector<idx_t> start{0}, neighbour, weight, order(g.members.size()), place(g.members.size());
  std::vector<std::int32_t> seen_by(g.members.size(), -1);
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(g.members.size()); ++v) {
    seen_by[at(v)] = v;
    for (const std::int32_t k : g.members[at(v)]) {
      for (const std::int32_t r : rows_of(m, k)) {
        const std::int32_t other = g.vertex[at(r)];
        if (seen_by[at(other)] == v) continue;
        seen_by[at(other)] = v;
        neighbour.push_back(other);
      }
    }
    start.push_back(static_cast<idx_t>(neighbour.size()));
    weight.push_back(static_cast<idx_t>(g.members[at(v)].size()));
  }
  constexpr idx_t worth_dissecting = 10;
  if (count < worth_dissecting) {
    std::iota(order.begin(), order.end(), idx_t{0});
  } else {
    std::vector<idx_t> options(METIS_NOPTIONS);
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_SEED] = 1;
    static std::mutex one_at_a_time;  // its random numbers have one state
    const std::lock_guard lock(one_at_a_time);
    const int status =
        METIS_NodeND(&count, start.data(), neighbour.data(), weight.data(), options.data(), order.data(), place.data());
    if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
    if (status != METIS_OK) return std::nullopt;
  }
  std::vector<std::int32_t> found(at(m.columns));
  std::int32_t next = 0;
  for (const idx_t v : order) {
    for (const std::int32_t k : g.members[at(v)]) found[at(k)] = next++;
  }
  return found;
}

}  // namespace dynalin

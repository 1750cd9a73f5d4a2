#include "system/nested_dissection.h"

#include <metis.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <numeric>
#include <span>
#include <unordered_map>
#include <vector>

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

// What the graph is made of.
class Vertices {
 public:
  explicit Vertices(const ColumnMatrix& m) : m_(m), of_(at(m.columns), -1) {
    std::vector<bool> pivot(of_.size());
    for (std::int32_t k = 0; k < m.columns; ++k) pivot[at(k)] = has_pivot(m, k);
    gather(pivot);
    const std::size_t with_pivot = members_.size();
    find_between(pivot, with_pivot);
    // Multipliers beside a body that comes before them; the others behind the neighbour with the fewest members.
    std::vector<bool> led(of_.size(), false);
    for (std::int32_t k = 0; k < m.columns; ++k) {
      for (const std::int32_t r : rows_of(m, k)) {
        if (!pivot[at(k)] && pivot[at(r)] && between_[at(of_[at(r)])]) led[at(k)] = true;
      }
    }
    gather(led);
    for (std::int32_t k = 0; k < m.columns; ++k) {
      if (of_[at(k)] >= 0) continue;
      std::int32_t best = -1;
      for (const std::int32_t r : rows_of(m, k)) {
        const std::int32_t v = pivot[at(r)] ? of_[at(r)] : -1;
        if (v >= 0 && (best < 0 || members_[at(v)].size() < members_[at(best)].size())) best = v;
      }
      put(k, best >= 0 ? best : new_vertex());
    }
    between_.resize(members_.size(), false);
    find_neighbours();
  }

  std::int32_t count() const { return static_cast<std::int32_t>(members_.size()); }
  const std::vector<std::int32_t>& members(std::int32_t v) const { return members_[at(v)]; }
  const std::vector<std::int32_t>& neighbours(std::int32_t v) const { return neighbours_[at(v)]; }
  // Whether it is no vertex of the graph, but what connects its neighbours.
  bool between(std::int32_t v) const { return between_[at(v)]; }

 private:
  void put(std::int32_t k, std::int32_t vertex) {
    of_[at(k)] = vertex;
    members_[at(vertex)].push_back(k);
  }
  std::int32_t new_vertex() {
    members_.emplace_back();
    return count() - 1;
  }
  // Unknowns that have the same rows, among those that are wanted.
  void gather(const std::vector<bool>& wanted) {
    std::unordered_map<std::uint64_t, std::int32_t> found;
    for (std::int32_t k = 0; k < m_.columns; ++k) {
      if (!wanted[at(k)]) continue;
      const auto own = rows_of(m_, k);
      const auto [it, is_new] = found.try_emplace(hash(own), -1);
      if (is_new) it->second = new_vertex();
      const auto& others = members_[at(it->second)];
      const auto rows = others.empty() ? own : rows_of(m_, others.front());
      put(k, std::equal(own.begin(), own.end(), rows.begin(), rows.end()) ? it->second : new_vertex());
    }
  }
  static std::uint64_t hash(std::span<const std::int32_t> rows) {
    std::uint64_t h = 14695981039346656037u;  // FNV
    for (const std::int32_t r : rows) h = (h ^ static_cast<std::uint64_t>(r)) * 1099511628211u;
    return h;
  }
  void find_between(const std::vector<bool>& pivot, std::size_t with_pivot) {
    constexpr std::size_t most_multipliers = 300;  // all of them are connected to each other
    between_.assign(with_pivot, true);
    for (std::size_t v = 0; v < with_pivot; ++v) {
      const auto rows = rows_of(m_, members_[v].front());
      std::size_t multipliers = 0;
      for (const std::int32_t r : rows) {
        if (!pivot[at(r)]) {
          ++multipliers;
        } else if (at(of_[at(r)]) != v) {
          between_[v] = false;
        }
      }
      if (multipliers == 0 || multipliers > most_multipliers) between_[v] = false;
    }
  }
  void find_neighbours() {
    neighbours_.resize(members_.size());
    std::vector<std::int32_t> seen_by(members_.size(), -1);
    for (std::int32_t v = 0; v < count(); ++v) {
      seen_by[at(v)] = v;
      for (const std::int32_t k : members(v)) {
        for (const std::int32_t r : rows_of(m_, k)) {
          const std::int32_t other = of_[at(r)];
          if (seen_by[at(other)] == v) continue;
          seen_by[at(other)] = v;
          neighbours_[at(v)].push_back(other);
        }
      }
    }
  }

  const ColumnMatrix& m_;
  std::vector<std::int32_t> of_;  // the vertex of each unknown
  std::vector<std::vector<std::int32_t>> members_, neighbours_;
  std::vector<bool> between_;
};

// Vertices that have neighbours, as METIS wants them.
struct Graph {
  std::vector<std::int32_t> vertex;
  std::vector<idx_t> start{0}, neighbour, weight;

  explicit Graph(const Vertices& all) {
    std::vector<std::int32_t> number(at(all.count()), -1), seen_by = number;
    for (std::int32_t v = 0; v < all.count(); ++v) {
      if (all.between(v) || all.neighbours(v).empty()) continue;
      number[at(v)] = static_cast<std::int32_t>(vertex.size());
      vertex.push_back(v);
    }
    for (const std::int32_t v : vertex) {
      seen_by[at(v)] = v;
      const auto connect = [&](std::int32_t other) {
        if (seen_by[at(other)] == v) return;
        seen_by[at(other)] = v;
        neighbour.push_back(number[at(other)]);
      };
      for (const std::int32_t other : all.neighbours(v)) {
        if (!all.between(other)) {
          connect(other);
        } else {
          for (const std::int32_t beyond : all.neighbours(other)) connect(beyond);
        }
      }
      start.push_back(static_cast<idx_t>(neighbour.size()));
      weight.push_back(static_cast<idx_t>(all.members(v).size()));
    }
  }
};

// Positions in the graph, first to last; nothing if METIS cannot say.
std::optional<std::vector<idx_t>> dissected(Graph& g) {
  auto count = static_cast<idx_t>(g.vertex.size());
  std::vector<idx_t> order(g.vertex.size()), place(order.size());
  std::iota(order.begin(), order.end(), idx_t{0});
  constexpr idx_t worth_dissecting = 10;
  if (count < worth_dissecting) return order;
  std::vector<idx_t> options(METIS_NOPTIONS);
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;
  static std::mutex one_at_a_time;  // its random numbers have one state
  const std::lock_guard lock(one_at_a_time);
  const int status = METIS_NodeND(&count, g.start.data(), g.neighbour.data(), g.weight.data(), options.data(),
                                  order.data(), place.data());
  if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
  if (status != METIS_OK) return std::nullopt;
  return order;
}

}  // namespace

std::optional<std::vector<std::int32_t>> nested_dissection(const ColumnMatrix& m) {
  if (m.columns == 0 || !has_symmetric_pattern(m)) return std::nullopt;
  const Vertices all(m);
  Graph graph(all);
  const auto order = dissected(graph);
  if (!order) return std::nullopt;
  std::vector<std::int32_t> place(at(m.columns));
  std::vector<bool> placed(at(all.count()), false);
  std::int32_t next = 0;
  const auto put = [&](std::int32_t v) {
    if (placed[at(v)]) return;
    placed[at(v)] = true;
    for (const std::int32_t k : all.members(v)) place[at(k)] = next++;
  };
  for (const idx_t k : *order) {
    const std::int32_t v = graph.vertex[at(k)];
    for (const std::int32_t other : all.neighbours(v)) {
      if (all.between(other)) put(other);
    }
    put(v);
  }
  for (std::int32_t v = 0; v < all.count(); ++v) put(v);
  return place;
}

}  // namespace dynalin

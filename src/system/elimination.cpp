#include "system/elimination.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace dynalin {

namespace {

// Entries this small, relative to the row as it was given, are rounding left behind by cancellation.
constexpr double left_by_cancellation = 1e-14;

// Columns count by their places in the order.
struct WorkRow {
  std::vector<std::pair<std::int32_t, double>> entries;  // ascending columns
  double first_size = 0;                                 // largest entry as given
  double size = 0;                                       // largest entry now
  std::int32_t listed_for = -1;                          // the column that was offered last with this row
  bool active = true;

  const double* find(std::int32_t column) const {
    // What stands before it was offered before: mostly nothing.
    if (entries.front().first >= column) return entries.front().first == column ? &entries.front().second : nullptr;
    const auto it = std::lower_bound(entries.begin(), entries.end(), column,
                                     [](const auto& e, std::int32_t c) { return e.first < c; });
    return it != entries.end() && it->first == column ? &it->second : nullptr;
  }
  std::int32_t reach() const { return entries.back().first; }
};

class Eliminator {
 public:
  Eliminator(std::vector<SparseRow> rows, std::int32_t columns, std::span<const std::int32_t> order,
             const EliminationOptions& options)
      : options_(options), order_(order), holders_(static_cast<std::size_t>(columns)) {
    std::vector<std::int32_t> place(static_cast<std::size_t>(columns));
    for (std::size_t k = 0; k < order.size(); ++k)
      place[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
    result_.pivot_column.assign(rows.size(), -1);
    result_.dependent.assign(static_cast<std::size_t>(columns), false);
    rows_.resize(rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r) load(r, rows[r], place);
  }

  Elimination run() {
    // A row whose large entries were passed over may be left with them alone: offer those columns again.
    while (remaining_ > 0) {
      const std::size_t before = remaining_;
      for (std::size_t k = 0; k < order_.size() && remaining_ > 0; ++k) {
        if (!result_.dependent[static_cast<std::size_t>(order_[k])]) offer(static_cast<std::int32_t>(k));
      }
      if (remaining_ == before) break;
    }
    return std::move(result_);
  }

 private:
  void load(std::size_t r, const SparseRow& given, const std::vector<std::int32_t>& place) {
    WorkRow& row = rows_[r];
    for (std::size_t k = 0; k < given.column.size(); ++k) {
      if (given.value[k] == 0.0) continue;
      row.entries.emplace_back(place[static_cast<std::size_t>(given.column[k])], given.value[k]);
      row.size = std::max(row.size, std::abs(given.value[k]));
    }
    std::sort(row.entries.begin(), row.entries.end());
    row.first_size = row.size;
    const double cut = left_by_cancellation * row.size;
    std::erase_if(row.entries, [&](const auto& e) { return std::abs(e.second) <= cut; });
    row.active = !row.entries.empty();
    if (!row.active) return;
    ++remaining_;
    for (const auto& [c, v] : row.entries) {
      holders_[static_cast<std::size_t>(c)].push_back(static_cast<std::int32_t>(r));
    }
  }

  void offer(std::int32_t column) {
    auto& holders = holders_[static_cast<std::size_t>(column)];
    // Rows that end soonest in the order go first: what loops leave over then lives on few columns, and dependent rows
    // vanish there instead of being carried through the whole model. Among equals the sparsest,
    // then the first. Lists name rows that lost the column, and some twice.
    std::int32_t best = -1;
    auto best_key = std::tuple(std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::size_t>::max(), 0);
    std::size_t kept = 0;
    for (const std::int32_t r : holders) {
      WorkRow& row = rows_[static_cast<std::size_t>(r)];
      const double* v = row.active && row.listed_for != column ? row.find(column) : nullptr;
      if (!v) continue;
      row.listed_for = column;
      holders[kept++] = r;
      const auto key = std::tuple(row.reach(), row.entries.size(), r);
      if (std::abs(*v) >= options_.pivot_threshold * row.size && key < best_key) {
        best = r;
        best_key = key;
      }
    }
    holders.resize(kept);
    for (const std::int32_t r : holders) rows_[static_cast<std::size_t>(r)].listed_for = -1;
    if (best < 0) return;

    WorkRow& pivot = rows_[static_cast<std::size_t>(best)];
    const double pivot_value = *pivot.find(column);
    pivot.active = false;
    --remaining_;
    const std::int32_t taken = order_[static_cast<std::size_t>(column)];
    result_.pivot_column[static_cast<std::size_t>(best)] = taken;
    result_.dependent[static_cast<std::size_t>(taken)] = true;
    ++result_.rank;
    for (const std::int32_t r : holders) {
      if (r != best) subtract(r, pivot, column, pivot_value);
    }
    holders.clear();
  }

  void subtract(std::int32_t r, const WorkRow& pivot, std::int32_t column, double pivot_value) {
    WorkRow& row = rows_[static_cast<std::size_t>(r)];
    const double factor = *row.find(column) / pivot_value;
    const double cut = left_by_cancellation * std::max(row.first_size, std::abs(factor) * pivot.first_size);
    merged_.resize(row.entries.size() + pivot.entries.size());
    auto out = merged_.begin();
    double size = 0;
    const auto keep = [&](std::int32_t c, double v) {
      *out++ = {c, v};
      size = std::max(size, std::abs(v));
    };
    auto a = row.entries.cbegin();
    auto b = pivot.entries.cbegin();
    const auto end_a = row.entries.cend(), end_b = pivot.entries.cend();
    while (b != end_b) {
      const std::int32_t c = b->first;
      for (; a != end_a && a->first < c; ++a) keep(a->first, a->second);
      const bool both = a != end_a && a->first == c;
      const double v = (both ? a->second : 0.0) - factor * b->second;
      if (c != column && std::abs(v) > cut) {
        keep(c, v);
        if (!both) holders_[static_cast<std::size_t>(c)].push_back(r);
      }
      if (both) ++a;
      ++b;
    }
    for (; a != end_a; ++a) keep(a->first, a->second);
    row.entries.assign(merged_.begin(), out);
    row.size = size;
    if (row.size <= options_.rank_tolerance * row.first_size) {
      result_.largest_dropped = std::max(result_.largest_dropped, row.size / row.first_size);
      row.active = false;
      row.entries.clear();
      --remaining_;
    }
  }

  EliminationOptions options_;
  std::span<const std::int32_t> order_;
  std::vector<WorkRow> rows_;
  std::vector<std::vector<std::int32_t>> holders_;  // rows that may hold a column
  std::vector<std::pair<std::int32_t, double>> merged_;
  std::size_t remaining_ = 0;
  Elimination result_;
};

}  // namespace

Elimination eliminate(std::vector<SparseRow> rows, std::int32_t columns, std::span<const std::int32_t> order,
                      const EliminationOptions& options) {
  return Eliminator(std::move(rows), columns, order, options).run();
}

}  // namespace dynalin

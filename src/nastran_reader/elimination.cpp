#include "nastran_reader/elimination.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

namespace dynalin::nastran_reader {

namespace {

using Entry = std::pair<int, double>;  // column, value
using SparseRow = std::vector<Entry>;  // in the order of columns

// A pivot is at least so much of the largest entry of its row, so that entries of T stay small.
constexpr double pivot_share = 0.5;
// A row of which less is left waits for the others: it may turn out to be redundant.
constexpr double waiting_below = 1e-3;
// What differs by less is the same number computed in two ways.
constexpr double cancelled_coefficient = 64 * std::numeric_limits<double>::epsilon();

double power_of_two(double x) { return std::exp2(-std::round(std::log2(x))); }

// Gaussian elimination of sparse rows. Rows and columns are scaled to entries near one first, so that millimetres and
// radians compare.
class Eliminator {
 public:
  Eliminator(const Equations& equations) : n_(static_cast<int>(equations.fixed.size())), fixed_(equations.fixed) {
    for (const ConstraintRow& r : equations.rows) {
      SparseRow row;
      for (const auto& [f, value] : r.terms) {
        // A freedom that is held drops out of every equation.
        if (!fixed_[static_cast<std::size_t>(f)]) row.emplace_back(f, value);
      }
      std::sort(row.begin(), row.end());
      rows_.push_back(std::move(row));
    }
    scale();
  }

  Elimination run() {
    const std::size_t count = rows_.size();
    state_.assign(count, {});
    holders_.assign(static_cast<std::size_t>(n_), {});
    for (std::size_t r = 0; r < count; ++r) {
      for (const auto& [c, value] : rows_[r]) {
        holders_[static_cast<std::size_t>(c)].insert(static_cast<int>(r));
        state_[r].peak = std::max(state_[r].peak, std::abs(value));
      }
      enqueue(r);
    }
    while (!queue_.empty()) {
      const auto [waits, fill, share, r] = *queue_.begin();
      queue_.erase(queue_.begin());
      take(static_cast<std::size_t>(r));
    }
    return result();
  }

 private:
  struct State {
    double peak = 0;     // the largest entry that it ever had
    double largest = 0;  // that it has
  };
  // Short rows first; among those that wait, those of which most is left.
  using Key = std::tuple<bool, std::size_t, double, int>;

  void scale() {
    column_scale_.assign(static_cast<std::size_t>(n_), 1);
    for (int pass = 0; pass < 6; ++pass) {
      std::vector<double> of_column(column_scale_.size(), 0);
      for (SparseRow& row : rows_) {
        double largest = 0;
        for (const auto& [c, value] : row) largest = std::max(largest, std::abs(value));
        if (largest == 0) continue;
        const double f = pass % 2 == 0 || pass == 5 ? power_of_two(largest) : power_of_two(std::sqrt(largest));
        for (auto& [c, value] : row) {
          value *= f;
          double& most = of_column[static_cast<std::size_t>(c)];
          most = std::max(most, std::abs(value));
        }
      }
      if (pass == 5) break;
      for (std::size_t c = 0; c < of_column.size(); ++c) {
        of_column[c] = of_column[c] > 0 ? power_of_two(std::sqrt(of_column[c])) : 1;
        column_scale_[c] *= of_column[c];
      }
      for (SparseRow& row : rows_) {
        for (auto& [c, value] : row) value *= of_column[static_cast<std::size_t>(c)];
      }
    }
  }

  void enqueue(std::size_t r) {
    State& s = state_[r];
    s.largest = 0;
    for (const auto& [c, value] : rows_[r]) s.largest = std::max(s.largest, std::abs(value));
    queue_.insert(key(r));
  }
  Key key(std::size_t r) const {
    const State& s = state_[r];
    const bool waits = s.largest < waiting_below * s.peak;
    return {waits, waits ? 0 : rows_[r].size(), waits ? -s.largest / s.peak : 0, static_cast<int>(r)};
  }

  void take(std::size_t r) {
    SparseRow& row = rows_[r];
    const State& s = state_[r];
    const double left = s.peak > 0 ? s.largest / s.peak : 0;
    if (row.empty() || left <= redundant_below) {
      out_.redundant.push_back({r, left});
      for (const auto& [c, value] : row) holders_[static_cast<std::size_t>(c)].erase(static_cast<int>(r));
      row.clear();
      return;
    }
    if (left <= nearly_redundant_below) out_.nearly_redundant.push_back({r, left});
    // The column that fewest other rows hold.
    int pivot = -1;
    double pivot_value = 0;
    std::size_t fewest = 0;
    for (const auto& [c, value] : row) {
      if (std::abs(value) < pivot_share * s.largest) continue;
      const std::size_t holders = holders_[static_cast<std::size_t>(c)].size();
      if (pivot >= 0 && (holders > fewest || (holders == fewest && std::abs(value) <= std::abs(pivot_value)))) continue;
      pivot = c, pivot_value = value, fewest = holders;
    }
    for (const auto& [c, value] : row) holders_[static_cast<std::size_t>(c)].erase(static_cast<int>(r));
    const std::set<int> others = std::move(holders_[static_cast<std::size_t>(pivot)]);
    holders_[static_cast<std::size_t>(pivot)].clear();
    for (const int other : others) subtract(static_cast<std::size_t>(other), row, pivot, pivot_value);
    pivots_.push_back({r, pivot, pivot_value});
  }

  // Takes the pivot column out of another row.
  void subtract(std::size_t other, const SparseRow& row, int pivot, double pivot_value) {
    queue_.erase(key(other));
    SparseRow& target = rows_[other];
    const auto at = std::lower_bound(target.begin(), target.end(), Entry{pivot, -HUGE_VAL});
    const double factor = at->second / pivot_value;
    SparseRow merged;
    merged.reserve(target.size() + row.size());
    auto a = target.begin();
    auto b = row.begin();
    while (a != target.end() || b != row.end()) {
      if (b == row.end() || (a != target.end() && a->first < b->first)) {
        merged.push_back(*a++);
        continue;
      }
      const double change = -factor * b->second;
      if (a == target.end() || b->first < a->first) {
        merged.emplace_back(b->first, change);
        holders_[static_cast<std::size_t>(b->first)].insert(static_cast<int>(other));
        ++b;
        continue;
      }
      const double sum = a->second + change;
      if (a->first != pivot) {
        if (std::abs(sum) > cancelled_coefficient * std::max(std::abs(a->second), std::abs(change))) {
          merged.emplace_back(a->first, sum);
        } else {
          holders_[static_cast<std::size_t>(a->first)].erase(static_cast<int>(other));
        }
      }
      ++a, ++b;
    }
    target = std::move(merged);
    State& s = state_[other];
    s.largest = 0;
    for (const auto& [c, value] : target) s.largest = std::max(s.largest, std::abs(value));
    s.peak = std::max(s.peak, s.largest);
    queue_.insert(key(other));
  }

  // Pivots from the last to the first: each depends on later ones and on what is independent.
  Elimination result() {
    std::vector<int> column_of(static_cast<std::size_t>(n_), -1);
    std::vector<bool> dependent(fixed_);
    for (const Pivot& p : pivots_) dependent[static_cast<std::size_t>(p.column)] = true;
    std::vector<SparseRow> T(static_cast<std::size_t>(n_));
    for (int f = 0; f < n_; ++f) {
      if (dependent[static_cast<std::size_t>(f)]) continue;
      const int column = static_cast<int>(out_.independent.size());
      out_.independent.push_back(f);
      T[static_cast<std::size_t>(f)] = {{column, 1.0}};
    }
    const std::size_t width = out_.independent.size();
    std::vector<double> sum(width, 0), size(width, 0);
    std::vector<bool> touched(width, false);
    for (auto p = pivots_.rbegin(); p != pivots_.rend(); ++p) {
      std::vector<int> used;
      for (const auto& [c, value] : rows_[p->row]) {
        if (c == p->column) continue;
        // Back to the user's units: columns have their scales, and that of the row drops out.
        const double share = -(value / p->value) * (column_scale_[static_cast<std::size_t>(p->column)] /
                                                    column_scale_[static_cast<std::size_t>(c)]);
        for (const auto& [k, entry] : T[static_cast<std::size_t>(c)]) {
          const auto at = static_cast<std::size_t>(k);
          if (!touched[at]) touched[at] = true, used.push_back(k);
          sum[at] += share * entry;
          size[at] = std::max(size[at], std::abs(share * entry));
        }
      }
      std::sort(used.begin(), used.end());
      SparseRow& row = T[static_cast<std::size_t>(p->column)];
      for (const int k : used) {
        const auto at = static_cast<std::size_t>(k);
        if (std::abs(sum[at]) > cancelled_coefficient * size[at]) row.emplace_back(k, sum[at]);
        sum[at] = size[at] = 0, touched[at] = false;
      }
    }
    std::size_t entries = 0;
    for (const SparseRow& row : T) entries += row.size();
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(entries);
    for (int f = 0; f < n_; ++f) {
      for (const auto& [k, value] : T[static_cast<std::size_t>(f)]) triplets.emplace_back(f, k, value);
    }
    out_.T.resize(n_, static_cast<int>(width));
    out_.T.setFromTriplets(triplets.begin(), triplets.end());
    return std::move(out_);
  }

  struct Pivot {
    std::size_t row;
    int column;
    double value;
  };

  int n_;
  std::vector<bool> fixed_;
  std::vector<SparseRow> rows_;
  std::vector<double> column_scale_;
  std::vector<State> state_;
  std::vector<std::set<int>> holders_;  // of each column the rows that have it
  std::set<Key> queue_;
  std::vector<Pivot> pivots_;
  Elimination out_;
};

}  // namespace

Elimination eliminate(const Equations& equations) { return Eliminator(equations).run(); }

}  // namespace dynalin::nastran_reader

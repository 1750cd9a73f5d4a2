#include "system/row_matching.h"

#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

// Whether an entry may be a pivot as it stands: elimination that has to leave the matched entry for a larger one of its
// column leaves the order that was to keep factors sparse as well. Rows count in units of their largest entry, as they
// do in KLU.
std::vector<bool> large_entries(const ColumnMatrix& m) {
  constexpr double large_part = 0.1;
  std::vector<double> row(static_cast<std::size_t>(m.rows), 0.0);
  for_each_entry(m, [&](std::int32_t r, std::int32_t, double v) {
    double& largest = row[static_cast<std::size_t>(r)];
    largest = std::max(largest, std::abs(v));
  });
  std::vector<bool> large(m.value.size(), false);
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.columns); ++c) {
    const auto first = static_cast<std::size_t>(m.start[c]), last = static_cast<std::size_t>(m.start[c + 1]);
    const auto size = [&](std::size_t k) {
      const double unit = row[static_cast<std::size_t>(m.row[k])];
      return unit > 0 ? std::abs(m.value[k]) / unit : 0.0;
    };
    double largest = 0;
    for (std::size_t k = first; k < last; ++k) largest = std::max(largest, size(k));
    for (std::size_t k = first; k < last; ++k) large[k] = largest > 0 && size(k) >= large_part * largest;
  }
  return large;
}

// Hopcroft and Karp (1973): each phase extends the matching along shortest paths alone, so that what is nearly matched,
// like the equations of links and joints, is done in one or two, however long the chain is. Depth first, as
// btf_maxtrans goes, paths run through the whole model.
class Matching {
 public:
  explicit Matching(const ColumnMatrix& m)
      : m_(m), usable_(large_entries(m)), row_of_(size(), -1), column_of_(size(), -1) {}

  // Entries that are large as far as they go, and then what the pattern has besides.
  std::vector<std::int32_t> rows() && {
    match();
    usable_.assign(usable_.size(), true);
    match();
    std::int32_t next = 0;
    for (std::int32_t& r : row_of_) {
      if (r >= 0) continue;
      while (column_of_[index(next)] >= 0) ++next;
      r = next++;
    }
    return std::move(row_of_);
  }

 private:
  static constexpr std::int32_t far = -1;
  static std::size_t index(std::int32_t k) { return static_cast<std::size_t>(k); }
  std::size_t size() const { return index(m_.columns); }
  void pair(std::int32_t row, std::int32_t column) {
    row_of_[index(column)] = row;
    column_of_[index(row)] = column;
  }

  // Diagonals first.
  void match() {
    for (std::int32_t c = 0; c < m_.columns; ++c) {
      if (row_of_[index(c)] >= 0 || column_of_[index(c)] >= 0) continue;
      for_each_usable(c, [&](std::int32_t r) {
        if (r == c) pair(r, c);
      });
    }
    while (find_distances()) extend();
  }

  template <class Function>
  void for_each_usable(std::int32_t column, Function&& use) const {
    const auto last = index(m_.start[index(column) + 1]);
    for (auto k = index(m_.start[index(column)]); k < last; ++k) {
      if (usable_[k]) use(m_.row[k]);
    }
  }

  // Of each column from one without a row, in exchanges; whether any leads to a row without a column.
  bool find_distances() {
    distance_.assign(size(), far);
    std::vector<std::int32_t> queue;
    for (std::int32_t c = 0; c < m_.columns; ++c) {
      if (row_of_[index(c)] >= 0) continue;
      distance_[index(c)] = 0;
      queue.push_back(c);
    }
    bool found = false;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const std::int32_t c = queue[head];
      for_each_usable(c, [&](std::int32_t r) {
        const std::int32_t next = column_of_[index(r)];
        found = found || next < 0;
        if (next < 0 || distance_[index(next)] != far) return;
        distance_[index(next)] = distance_[index(c)] + 1;
        queue.push_back(next);
      });
    }
    return found;
  }

  // Along paths that share no column.
  void extend() {
    next_.assign(m_.start.begin(), m_.start.end() - 1);
    for (std::int32_t c = 0; c < m_.columns; ++c) {
      if (row_of_[index(c)] < 0) extend_from(c);
    }
  }

  void extend_from(std::int32_t first) {
    std::vector<std::int32_t> path = {first};
    while (!path.empty()) {
      const auto c = index(path.back());
      if (next_[c] == m_.start[c + 1]) {  // a dead end
        distance_[c] = far;
        path.pop_back();
        if (!path.empty()) ++next_[index(path.back())];
        continue;
      }
      if (!usable_[index(next_[c])]) {
        ++next_[c];
        continue;
      }
      const std::int32_t other = column_of_[index(m_.row[index(next_[c])])];
      if (other < 0) {
        for (auto at = path.rbegin(); at != path.rend(); ++at) pair(m_.row[index(next_[index(*at)])], *at);
        return;
      }
      if (distance_[index(other)] == distance_[c] + 1) {
        path.push_back(other);
      } else {
        ++next_[c];
      }
    }
  }

  const ColumnMatrix& m_;
  std::vector<bool> usable_;  // entries
  std::vector<std::int32_t> row_of_, column_of_, distance_;
  std::vector<std::int32_t> next_;  // entry of each column to be tried
};

}  // namespace

std::vector<std::int32_t> matched_rows(const ColumnMatrix& m) { return Matching(m).rows(); }

std::vector<std::int32_t> rows_with_matched_first(const ColumnMatrix& m) {
  const std::vector<std::int32_t> matched = matched_rows(m);
  std::vector<std::int32_t> rows = m.row;
  for (std::size_t c = 0; c < matched.size(); ++c) {
    const auto first = rows.begin() + m.start[c], last = rows.begin() + m.start[c + 1];
    if (const auto at = std::find(first, last, matched[c]); at != last) std::iter_swap(first, at);
  }
  return rows;
}

std::vector<std::int32_t> rows_for_analysis(const ColumnMatrix& m) {
  constexpr std::int32_t large = 5000;
  return m.columns < large ? m.row : rows_with_matched_first(m);
}

}  // namespace dynalin

#include "system/row_matching.h"

#include <algorithm>

namespace dynalin {

namespace {

// Hopcroft and Karp (1973): each phase extends the matching along shortest paths alone, so that what is nearly matched,
// like the equations of links and joints, is done in one or two, however long the chain is. Depth first, as
// btf_maxtrans goes, paths run through the whole model.
class Matching {
 public:
  explicit Matching(const ColumnMatrix& m) : m_(m), row_of_(size(), -1), column_of_(size(), -1) {
    for (std::int32_t c = 0; c < m.columns; ++c) {
      for_each_in_column(m, c, [&](std::int32_t r, double) {
        if (r == c) pair(r, c);
      });
    }
  }

  std::vector<std::int32_t> rows() && {
    while (find_distances()) extend();
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
      for_each_in_column(m_, c, [&](std::int32_t r, double) {
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

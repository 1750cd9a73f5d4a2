#include "mechanics/accumulator.h"

#include <algorithm>

namespace dynalin {

void ColumnMatrix::multiply_add(std::span<const double> x, std::span<double> y, double factor) const {
  for (std::int32_t c = 0; c < columns; ++c) {
    const double scaled = factor * x[static_cast<std::size_t>(c)];
    if (scaled == 0.0) continue;
    for (std::int32_t k = start[static_cast<std::size_t>(c)]; k < start[static_cast<std::size_t>(c) + 1]; ++k) {
      y[static_cast<std::size_t>(row[static_cast<std::size_t>(k)])] += value[static_cast<std::size_t>(k)] * scaled;
    }
  }
}

void Accumulator::resize(std::int32_t rows, std::int32_t columns) {
  recorded_ = false;
  runs_.clear();
  slots_.clear();
  next_ = 0;
  matrix_ = {};
  matrix_.rows = rows;
  matrix_.columns = columns;
}

void Accumulator::settle() {
  std::vector<std::int32_t>().swap(slots_);
  if (!recorded_) return;
  std::size_t kept = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(matrix_.columns); ++c) {
    const auto first = static_cast<std::size_t>(matrix_.start[c]),
               last = static_cast<std::size_t>(matrix_.start[c + 1]);
    matrix_.start[c] = static_cast<std::int32_t>(kept);
    // Behind `first`, which the column before has not reached.
    for (std::size_t k = first; k < last; ++k) {
      if (matrix_.value[k] == 0.0 && (!keeps_sizes_ || sizes_[k] == 0.0)) continue;
      matrix_.row[kept] = matrix_.row[k], matrix_.value[kept] = matrix_.value[k];
      if (keeps_sizes_) sizes_[kept] = sizes_[k];
      ++kept;
    }
  }
  matrix_.start.back() = static_cast<std::int32_t>(kept);
  const auto shorten = [kept](auto& entries) {
    entries.resize(std::min(kept, entries.size()));
    entries.shrink_to_fit();
  };
  shorten(matrix_.row), shorten(matrix_.value), shorten(sizes_);
}

void Accumulator::begin() {
  next_ = 0;
  if (recorded_) {
    std::fill(matrix_.value.begin(), matrix_.value.end(), 0.0);
    if (keeps_sizes_) sizes_.assign(matrix_.value.size(), 0.0);
  } else {
    runs_.clear();
  }
}

void Accumulator::finish() {
  if (recorded_) return;
  const auto columns = static_cast<std::size_t>(matrix_.columns);
  auto& start = matrix_.start;
  auto& row = matrix_.row;

  // Counting sort by column, then sort and compress the rows of each column.
  start.assign(columns + 1, 0);
  for (const Run& r : runs_) start[static_cast<std::size_t>(r.column) + 1] += r.count;
  for (std::size_t c = 0; c < columns; ++c) start[c + 1] += start[c];
  row.resize(static_cast<std::size_t>(start[columns]));
  std::vector<std::int32_t> fill(start.begin(), start.end() - 1);
  for (const Run& r : runs_) {
    for (std::int32_t k = 0; k < r.count; ++k) {
      row[static_cast<std::size_t>(fill[static_cast<std::size_t>(r.column)]++)] = r.row + k;
    }
  }
  std::int32_t kept = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    const auto first = row.begin() + start[c], last = row.begin() + fill[c];
    std::sort(first, last);
    const auto unique_last = std::unique(first, last);
    start[c] = kept;
    for (auto it = first; it != unique_last; ++it) row[static_cast<std::size_t>(kept++)] = *it;
  }
  start[columns] = kept;
  row.resize(static_cast<std::size_t>(kept));
  row.shrink_to_fit();
  matrix_.value.assign(static_cast<std::size_t>(kept), 0.0);

  // A run of consecutive rows stays consecutive in its column, so one slot a run is enough.
  slots_.resize(runs_.size());
  for (std::size_t k = 0; k < runs_.size(); ++k) {
    const Run& r = runs_[k];
    const auto c = static_cast<std::size_t>(r.column);
    const auto first = row.begin() + start[c], last = row.begin() + start[c + 1];
    slots_[k] = static_cast<std::int32_t>(std::lower_bound(first, last, r.row) - row.begin());
  }
  runs_.clear();
  runs_.shrink_to_fit();
  recorded_ = true;
}

}  // namespace dynalin

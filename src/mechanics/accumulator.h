// Assembly of a sparse matrix whose pattern comes from topology and is decided once.
//
// The first pass records where every contribution goes; later passes make the same calls in the same
// order and only add numbers. Explicit zeros stay, so a factorisation may re-use its symbolic analysis, until no
// further pass is to come.
#pragma once

#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace dynalin {

// Compressed columns; row indices ascend within a column.
struct ColumnMatrix {
  std::int32_t rows = 0, columns = 0;
  std::vector<std::int32_t> start;  // columns + 1
  std::vector<std::int32_t> row;
  std::vector<double> value;

  // y += factor · (this) x
  void multiply_add(std::span<const double> x, std::span<double> y, double factor = 1.0) const;
};

// f(row, value) for every entry of a column, in ascending rows.
template <class Function>
void for_each_in_column(const ColumnMatrix& m, std::int32_t column, Function&& f) {
  const auto c = static_cast<std::size_t>(column);
  for (auto k = static_cast<std::size_t>(m.start[c]); k < static_cast<std::size_t>(m.start[c + 1]); ++k) {
    f(m.row[k], m.value[k]);
  }
}

// f(row, column, value) for every entry.
template <class Function>
void for_each_entry(const ColumnMatrix& m, Function&& f) {
  for (std::int32_t c = 0; c < m.columns; ++c) {
    for_each_in_column(m, c, [&](std::int32_t r, double v) { f(r, c, v); });
  }
}

class Accumulator {
 public:
  void resize(std::int32_t rows, std::int32_t columns);
  bool recorded() const { return recorded_; }

  // Also keeps, from the next pass on, the sum of the sizes of all that is added to an entry.
  void keep_sizes() { keeps_sizes_ = true; }

  void begin();   // of a pass: zero values (or an empty record)
  void finish();  // of the recording pass: builds the pattern
  // There are no further passes: what they alone need goes, and with it entries that are zero and made of nothing.
  void settle();

  // Adds `values` to consecutive rows of one column. Their sizes are those that they have, or what they are made of.
  void add(std::int32_t row, std::int32_t column, std::span<const double> values, std::span<const double> sizes = {}) {
    if (!recorded_) {
      runs_.push_back({row, column, static_cast<std::int32_t>(values.size())});
      return;
    }
    assert(next_ < slots_.size());
    const std::int32_t slot = slots_[next_++];
    double* target = matrix_.value.data() + slot;
    for (const double v : values) *target++ += v;
    if (!keeps_sizes_) return;
    double* size = sizes_.data() + slot;
    for (const double v : sizes.empty() ? values : sizes) *size++ += std::abs(v);
  }
  void add(std::int32_t row, std::int32_t column, double value) { add(row, column, {&value, 1}); }

  // Entries that are no finite numbers become zero; take(row, column) for each.
  template <class Take>
  void clear_undefined(Take&& take) {
    for (std::int32_t c = 0; c < matrix_.columns; ++c) {
      for (auto k = static_cast<std::size_t>(matrix_.start[static_cast<std::size_t>(c)]);
           k < static_cast<std::size_t>(matrix_.start[static_cast<std::size_t>(c) + 1]); ++k) {
        if (std::isfinite(matrix_.value[k])) continue;
        take(matrix_.row[k], c);
        matrix_.value[k] = 0.0;
        if (keeps_sizes_) sizes_[k] = 0.0;
      }
    }
  }

  // Entries that are no more than rounding of what has been added up to them become zero; sizes must be kept.
  void clear_rounding() {
    constexpr double roundings = 16 * std::numeric_limits<double>::epsilon();
    for (std::size_t k = 0; k < sizes_.size(); ++k) {
      if (std::abs(matrix_.value[k]) <= roundings * sizes_[k]) matrix_.value[k] = 0.0;
    }
  }

  const ColumnMatrix& matrix() const { return matrix_; }
  std::span<const double> sizes() const { return sizes_; }  // entry by entry of matrix()

 private:
  struct Run {
    std::int32_t row, column, count;
  };
  bool recorded_ = false;
  std::vector<Run> runs_;            // only while recording
  std::vector<std::int32_t> slots_;  // where the run of each call starts in matrix_.value
  std::size_t next_ = 0;
  ColumnMatrix matrix_;
  bool keeps_sizes_ = false;
  std::vector<double> sizes_;
};

}  // namespace dynalin

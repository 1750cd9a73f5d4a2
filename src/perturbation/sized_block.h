// A block of the perturbation equations while they are put together: its entries, and what is known of their rounding
// (roundoff_scales.h) in a list of all blocks.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "mechanics/equations.h"
#include "system/sparse_lu.h"

namespace dynalin {

// Grows without being copied: of a large model it is the largest of all lists.
using Entries = std::deque<Triplet>;

// What roundings have left of entries, in half units of the last place; or, asked for on its own, the sizes of what
// entries are made of.
struct Roundoff {
  enum class Noted : std::uint8_t { roundings, sizes };
  Noted noted = Noted::roundings;
  Entries entries;

  void note(Noted what, std::int32_t row, std::int32_t column, double v) {
    if (noted == what && v > 0) entries.push_back({row, column, v});
  }
};

class SizedBlock {
 public:
  SizedBlock(std::int32_t row, std::int32_t column, Roundoff& roundoff)
      : row_(row), column_(column), roundoff_(roundoff) {}

  // What is zero at this point is left out, most entries of a chain at rest.
  Entries values;
  void add(std::int32_t r, std::int32_t c, double value, double size, double rounding) {
    if (value != 0.0) values.push_back({r, c, value});
    roundoff_.note(Roundoff::Noted::sizes, row_ + r, column_ + c, size);
    note_rounding(r, c, rounding);
  }
  // Of entries whose values stand elsewhere.
  void note_rounding(std::int32_t r, std::int32_t c, double rounding) {
    roundoff_.note(Roundoff::Noted::roundings, row_ + r, column_ + c, rounding);
  }
  template <class Row>
  void note_gradient(std::int32_t r, const Row& row, const std::vector<RowCoefficients>& size) {
    for (std::size_t e = 0; e < row.size(); ++e)
      roundoff_.note(Roundoff::Noted::sizes, row_ + r, column_ + row[e].column, size[e].g);
  }
  template <class Row>
  void note_gradient_roundings(std::int32_t r, const Row& row, const std::vector<RowCoefficients>& rounding) {
    for (std::size_t e = 0; e < row.size(); ++e) note_rounding(r, row[e].column, rounding[e].g);
  }

 private:
  std::int32_t row_, column_;
  Roundoff& roundoff_;
};

}  // namespace dynalin

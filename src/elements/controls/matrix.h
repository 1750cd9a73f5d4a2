// MATRIX as other controls see it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/source.h"

namespace dynalin {

struct Matrix {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;  // column by column
  std::string name;            // upper case; empty without NAME
  enum class Written : std::uint8_t { by_columns, by_rows, by_entries, in_a_file };
  Written written = Written::by_columns;
  Span values_at;  // the numbers as they are written, or the name of the file
  double operator()(std::size_t r, std::size_t c) const { return values[c * rows + r]; }
};

// Where the number of a row and a column is written; all of them, or the name of the file, where they do not stand one
// behind the other in the dataset.
Span place_of(const Matrix&, std::size_t row, std::size_t column);

}  // namespace dynalin

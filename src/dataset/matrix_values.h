// The numbers behind the header of one matrix, free of columns or in the columns of a FORTRAN
// format.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"

namespace dynalin {

struct MatrixBlock {
  const SourceText& file;
  std::string_view name;  // of the matrix, for messages
  Span header;
  std::size_t first_line;  // lines [first_line, end_line) hold the values
  std::size_t end_line;
  std::size_t value_count;  // numbers that must be there
  std::string_view format;  // as written, with its parentheses
};

// The numbers in the order of the file; problems are reported.
std::optional<std::vector<double>> read_matrix_values(const MatrixBlock& block, Diagnostics& diagnostics);

}  // namespace dynalin

// Reads one named matrix out of a file of matrices: ADAMSMAT, MATRIXx FSAVE, or MATSAVE laid out
// like FSAVE.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"

namespace dynalin {

struct MatrixData {
  std::string name;  // as the file writes it
  std::int32_t rows = 0, columns = 0;
  std::vector<double> values;  // column by column
};

// The matrix of that name in any case; an empty name takes the only matrix of the file. `asked_at`
// is the place that names the matrix, for the message if it is missing. Problems inside the file
// are reported at their place in the file, which must outlive the diagnostics.
std::optional<MatrixData> read_matrix(const SourceText& file, std::string_view name, const Span& asked_at,
                                      Diagnostics& diagnostics);

}  // namespace dynalin

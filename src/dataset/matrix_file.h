// Named matrices out of files of other programs: MATRIXx FSAVE and ADAMSMAT.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"

namespace dynalin {

struct FileMatrix {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;  // column by column
};

// The matrix `name` (case is not significant) of the file; what is wrong is reported at its place in the file.
std::optional<FileMatrix> read_matrix_file(const SourceRef&, std::string_view name, Diagnostics&);

}  // namespace dynalin

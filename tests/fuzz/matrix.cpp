// Any bytes as a file of matrices; a matrix that is read is written as FSAVE and read back, bit by bit.
#include <cmath>
#include <sstream>

#include "dataset/matrix_file.h"
#include "output/matrices.h"
#include "target.h"

namespace dynalin::fuzz {
namespace {

void write_and_read(const MatrixData& read) {
  NamedMatrix written{"A", "a", Eigen::MatrixXd(read.rows, read.columns)};
  for (std::int32_t c = 0; c < read.columns; ++c) {
    for (std::int32_t r = 0; r < read.rows; ++r) {
      const double value =
          read.values[static_cast<std::size_t>(c) * static_cast<std::size_t>(read.rows) + static_cast<std::size_t>(r)];
      demand(std::isfinite(value), "a value that is not finite");
      written.value(r, c) = value;
    }
  }
  std::ostringstream fsave, matlab;
  write_matlab(matlab, written);
  if (read.rows == 0 || read.columns == 0) return;
  write_fsave(fsave, {written}, 0);
  const SourceText file("again.mat", fsave.str());
  Diagnostics diagnostics;
  const auto again = read_matrix(file, "A", Span{}, diagnostics);
  demand(again && diagnostics.items().empty(), "an FSAVE file that was written is not read");
  demand(again->rows == read.rows && again->columns == read.columns, "an FSAVE file has another size");
  demand(again->values == read.values, "an FSAVE file has other values");
}

}  // namespace
}  // namespace dynalin::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace dynalin;
  const fuzz::TimeLimit limit;
  const SourceText file("fuzz.mat", fuzz::text_of(bytes, count));
  // Words of the file, some of which are names of matrices.
  constexpr std::size_t enough = 20;
  std::vector<std::string> names{"", "A", "x y"};
  std::istringstream words(std::string(file.text()));
  for (std::string word; names.size() < enough && words >> word;) names.push_back(word);
  for (const std::string& name : names) {
    Diagnostics diagnostics;
    const auto matrix = read_matrix(file, name, Span{&file, 0, 0}, diagnostics);
    fuzz::demand_sound(diagnostics);
    fuzz::demand(matrix.has_value() == !diagnostics.has_errors(), "neither a matrix nor an error, or both");
    if (!matrix) continue;
    fuzz::demand(
        matrix->values.size() == static_cast<std::size_t>(matrix->rows) * static_cast<std::size_t>(matrix->columns),
        "a matrix with another number of values");
    fuzz::write_and_read(*matrix);
  }
  return 0;
}

// Any bytes as each of the files that dynalin reduce reads: a value or an error at its place.
#include "reduction/coordinate_matrix.h"
#include "reduction/direct_matrices.h"
#include "reduction/freedom_list.h"
#include "reduction/node_list.h"
#include "target.h"

namespace dynalin::fuzz {
namespace {

using namespace reduction;

void demand_symmetric(const SparseMatrix& m) {
  const SparseMatrix transposed = m.transpose();
  for (Eigen::Index c = 0; c < m.cols(); ++c) {
    for (SparseMatrix::InnerIterator it(m, c); it; ++it)
      demand(it.value() == transposed.coeff(it.row(), c), "a matrix that is not symmetric");
  }
}

template <class Value>
void demand_one(const Value& value, const Diagnostics& diagnostics) {
  demand_sound(diagnostics);
  demand(value.has_value() != diagnostics.has_errors(), "neither a value nor an error, or both");
}

}  // namespace
}  // namespace dynalin::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace dynalin;
  const fuzz::TimeLimit limit;
  const SourceText file("fuzz.txt", fuzz::text_of(bytes, count));
  for (const Eigen::Index size : {2, 40}) {
    Diagnostics found;
    const auto matrix = reduction::read_coordinate_matrix(file, size, found);
    fuzz::demand_one(matrix, found);
    if (matrix) fuzz::demand_symmetric(*matrix);
  }
  Diagnostics of_freedoms, of_nodes, of_cards;
  fuzz::demand_one(reduction::read_freedoms(file, of_freedoms), of_freedoms);
  fuzz::demand_one(reduction::read_nodes(file, of_nodes), of_nodes);
  const auto cards = reduction::read_direct_matrices(file, "", file, "", of_cards);
  fuzz::demand_one(cards, of_cards);
  if (cards) fuzz::demand_symmetric(cards->stiffness), fuzz::demand_symmetric(cards->mass);
  return 0;
}

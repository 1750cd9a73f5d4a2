// Symmetric sparse matrices as lists of coordinates: Matrix Market files, and those that CalculiX stores.
#pragma once

#include <optional>

#include "base/diagnostics.h"
#include "reduction/finite_element_model.h"

namespace dynalin::reduction {

// A file that begins with %%MatrixMarket is `matrix coordinate real symmetric` (lower triangle) or `general` (both
// triangles, equal to 1e-8). Any other has lines `row column value`, counted from 1, with one triangle, as CalculiX
// writes its .sti and .mas. `size` is the number of freedoms. Problems are told at their place; nothing then.
std::optional<SparseMatrix> read_coordinate_matrix(const SourceText&, Eigen::Index size, Diagnostics&);

// Where the diagonal entry of a row stands in such a file; its beginning if it is not written.
Span diagonal_entry(const SourceText&, Eigen::Index size, Eigen::Index row);

}  // namespace dynalin::reduction

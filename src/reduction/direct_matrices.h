// Stiffness and mass out of DMIG cards, as Nastran punches those of a model that it has reduced.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "reduction/finite_element_model.h"

namespace dynalin::reduction {

struct DirectMatrices {
  std::vector<Freedom> freedoms;  // of grids (components 1 to 6) and scalar points (0)
  SparseMatrix stiffness, mass;
  std::vector<Span> stiffness_at, mass_at;  // where the diagonal entry of each freedom, or else the matrix, stands
};

// Names are those of the matrices; an empty one takes the only matrix that begins with K (but not K4) or M. Both files
// may be the same. Matrices are real, of form 6 (one triangle or both) or 1; grids have their axes along basic ones.
std::optional<DirectMatrices> read_direct_matrices(const SourceText& stiffness, const std::string& stiffness_name,
                                                   const SourceText& mass, const std::string& mass_name, Diagnostics&);

}  // namespace dynalin::reduction

// Which node and direction each row of the matrices is.
#pragma once

#include <optional>
#include <vector>

#include "base/diagnostics.h"
#include "reduction/finite_element_model.h"

namespace dynalin::reduction {

// A line for each row, `node.direction` as CalculiX writes its .dof or `node direction`; direction 1 to 6, or 0 for a
// coordinate without a place. Empty lines and lines that begin with # or % are passed over.
std::optional<std::vector<Freedom>> read_freedoms(const SourceText&, Diagnostics&);

}  // namespace dynalin::reduction

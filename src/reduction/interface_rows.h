// Which rows of the matrices the interface nodes have.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "base/diagnostics.h"
#include "reduction/finite_element_model.h"

namespace dynalin::reduction {

struct InterfaceRows {
  std::vector<Eigen::Index> interface;  // node by node in the order asked for, directions 1 to 6
  std::vector<Eigen::Index> interior;   // all others, ascending
};

// A node that has no freedoms, is asked for twice, or lacks directions is an error; rotations may be missing where they
// are not required.
std::optional<InterfaceRows> interface_rows(std::span<const Freedom>, std::span<const NodeLabel> interface,
                                            bool rotations_required, Diagnostics&);

}  // namespace dynalin::reduction

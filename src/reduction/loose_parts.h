// What the stiffness of a model does not hold: for messages, where a reduction has found that something moves freely.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "reduction/finite_element_model.h"

namespace dynalin::reduction {

// "node 3, direction 4", or "node 3" of a coordinate without a place.
std::string name_of(const Freedom&);

// Rows of zeros, or else a part that no entry connects to the node `seen_from`: what to say, and a row of it.
struct LoosePart {
  std::string text;
  Eigen::Index row = 0;
};
std::optional<LoosePart> loose_part(const FiniteElementModel&, NodeLabel seen_from);

// Of a symmetric matrix: the vector of its lowest eigenvalue where all are compared by the diagonal, each entry times
// the square root of its diagonal.
Eigen::VectorXd weakest_motion(const SparseMatrix&);

}  // namespace dynalin::reduction

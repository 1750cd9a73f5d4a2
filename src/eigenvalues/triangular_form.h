// The block triangular form of a square matrix that follows from which of its entries are zero (Tarjan's strongly
// connected components): entry (i, j) is an edge from j to i, and what a block reaches comes before it.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dynalin {

// Components in an order in which every one comes after all that it reaches.
std::vector<std::vector<Eigen::Index>> connected_components(const Eigen::Ref<const Eigen::MatrixXd>&);

// All that `from` reaches, itself left out unless it lies on a cycle.
std::vector<Eigen::Index> reached_from(const Eigen::Ref<const Eigen::MatrixXd>&, Eigen::Index from);

}  // namespace dynalin

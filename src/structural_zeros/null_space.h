// Directions that a set of rows does not see, and how many of some directions are independent.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <vector>

namespace dynalin {

// A basis of the vectors v with |row · v| of at most `limit` for every row, by QR with column pivoting; none if a row
// is not finite. Rows in units in which `limit` is rounding.
Eigen::MatrixXd null_space(const std::vector<Eigen::RowVectorXd>& rows, Eigen::Index columns, double limit);

// A direction of states that is computed, be it from such rows or as one of an invariant subspace, lies beside the
// space it belongs to by no more than this share of its length.
inline constexpr double beside_its_space = 1e-7;
// So what a unit vector has apart from others says that it is another direction if it is clearly more than that. Less
// is not told from none: a zero would be counted twice, where one that is left out is found as a small value.
inline constexpr double another_direction = 10 * beside_its_space;

// How many columns of about unit length are independent.
Eigen::Index independent_columns(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>&);

}  // namespace dynalin

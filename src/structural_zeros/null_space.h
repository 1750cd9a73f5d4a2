// Directions that a set of rows does not see.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dynalin {

// A basis of the vectors v with |row · v| of at most `limit` for every row, by QR with column pivoting; none if a row
// is not finite. Rows in units in which `limit` is rounding.
Eigen::MatrixXd null_space(const std::vector<Eigen::RowVectorXd>& rows, Eigen::Index columns, double limit);

}  // namespace dynalin

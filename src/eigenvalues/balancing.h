// Units for which all that couples vectors is of like size.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dynalin {

// Of each vector the power of two p for which columns times 2^p and rows by 2^p have norms within a factor of two or so
// of each other. `coupling` is square, its entries are sizes, and its diagonal counts for nothing. A row or column of
// zeros keeps its unit.
std::vector<int> balancing_powers(Eigen::MatrixXd coupling);

}  // namespace dynalin

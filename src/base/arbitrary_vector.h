// Vectors for iterations to start from, and for probing an operator.
#pragma once

#include <Eigen/Core>

namespace dynalin {

// Vectors without preferred direction, the same ones in every run.
Eigen::VectorXcd arbitrary_vector(Eigen::Index size, unsigned number);

}  // namespace dynalin

// The equations of a deck in its independent freedoms.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "nastran_reader/elimination.h"

namespace dynalin::nastran_reader {

struct Reduced {
  Eigen::MatrixXd M, B, K;
  std::vector<int> kept;       // of each row the column of T
  std::vector<int> untouched;  // freedoms that are independent and stand in no matrix: taken out
};

// TᵀMT and so on; what cancels up to rounding of its terms is zero.
Reduced reduce(const Equations&, const Elimination&);

}  // namespace dynalin::nastran_reader

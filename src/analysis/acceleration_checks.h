// What is looked at when accelerations are found: rows that contradict the others, and digits that are lost.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/acceleration_equations.h"
#include "system/sparse_lu.h"

namespace dynalin {

// Redundant rows whose second total derivative does not follow from the others; `rounding` is that of the unknowns.
std::vector<std::int32_t> contradicted_accelerations(const System&, const AccelerationEquations&, const OperatingPoint&,
                                                     const Eigen::VectorXd& rounding);

// How exact derivatives can be where the equations bend: solved for the same right-hand side at the ends of what is
// known of the unknowns, they give answers that differ by this part of themselves.
struct LostDigits {
  double part = 0;
  std::string of;  // "the value of VARIABLE/1"
};
LostDigits lost_digits(const System&, AccelerationEquations&, const SparseLu&, const ColumnMatrix& factored,
                       const OperatingPoint&, const Eigen::VectorXd& terms, const Eigen::VectorXd& uncertainty);

}  // namespace dynalin

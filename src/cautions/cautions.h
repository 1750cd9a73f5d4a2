// What makes a linear model and its modes other than they look (LINEAR command, "Advanced eigensolution issues").
#pragma once

#include "linear/linear_system.h"

namespace dynalin {

// Warnings, each with the part, joint or row it is about:
//   a singular configuration, whose dependent rows are independent right beside it: frequencies of nearby points
//   differ, a coordinate that moves out of all proportion to the chosen ones, as near such a configuration, parts that
//   accelerate or turn at the point: the eigenvalues hold for this instant, overdamped modes: real pairs where
//   vibrations would be without damping, joints in stiction, whose stiffness may make modes of its own, functions with
//   a kink or jump right at the point.
// Of the point an integration has left so much of its errors, as a part of the model's length; 0 where none has led to
// it.
Diagnostics cautions(const System&, const OperatingPoint&, const LinearSystem&, const EigenSolution&,
                     double left_by_integration = 0);
// Those among them that are true of matrices as well, and how few digits these have.
Diagnostics cautions_of_matrices(const System&, const OperatingPoint&, const LinearSystem&,
                                 double left_by_integration = 0);

}  // namespace dynalin

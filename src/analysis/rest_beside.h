// The point next to a given one at which everything is at rest but for forces along some motions, by which it does not
// move: where an equilibrium is one of many, another of them.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "system/system.h"

namespace dynalin {

// `kept` holds motions of all coordinates in columns. Nothing where Newton's method does not come to such a point.
std::optional<OperatingPoint> rest_beside(const System&, OperatingPoint, const Eigen::MatrixXd& kept);

}  // namespace dynalin

// The point next to a given one at which everything is at rest but for forces along some motions, by which it does not
// move: where an equilibrium is one of many, another of them.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "system/system.h"

namespace dynalin {

// A basis of the space of motions of all coordinates (columns), orthonormal in units of the coordinates' sizes, without
// what a motion of unit size has less than `dependent` of beside the others.
Eigen::MatrixXd basis_of_motions(const Eigen::MatrixXd& motions, const Eigen::VectorXd& size, double dependent);

// `kept` holds motions of all coordinates in columns. Nothing where Newton's method does not come to such a point.
std::optional<OperatingPoint> rest_beside(const System&, OperatingPoint, const Eigen::MatrixXd& kept);

}  // namespace dynalin

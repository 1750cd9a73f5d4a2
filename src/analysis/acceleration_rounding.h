// How exact accelerations and reactions can be at a point whose positions and velocities are rounded.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <random>

#include "analysis/augmented_system.h"
#include "system/sparse_lu.h"

namespace dynalin {

// A random displacement and change of velocities, each within some units in the last place of its vector.
struct Shake {
  Eigen::VectorXd step, velocity;
};
// `size`: of each coordinate, what its last place is counted from.
Shake shake(const Layout&, const OperatingPoint&, const std::vector<double>& size, double units, std::minstd_rand&);
OperatingPoint shaken(const System&, OperatingPoint, const Shake&, double direction);

// Minus the residuals at a point, in the order of the augmented matrix.
using MissingForces = std::function<Eigen::VectorXd(const OperatingPoint&)>;

// Of each unknown of the augmented equations, what roundings of the point may make of it: the answer of the factored
// equations to displacements and velocities of some units in the last place, taken both ways so that a law that
// switches at the point itself does not count.
Eigen::VectorXd rounding_of_accelerations(const System&, const SparseLu&, const OperatingPoint&, const MissingForces&);

// One sample of that, to see whether roundings of the point matter at all: the forces that are missing beside the
// point, and what a unit of the answer to them counts for.
Eigen::VectorXd missing_beside(const System&, const OperatingPoint&, const MissingForces&);
double rounding_of_answer();

// The same of what rounds in solving and evaluating the equations: their answer to some units in the last place of the
// terms of each.
Eigen::VectorXd rounding_of_solution(const SparseLu&, const Eigen::VectorXd& terms);

}  // namespace dynalin

// Equilibria that the loads of the drawn model push it away from: a search by Newton's method may climb onto them.
//
// At rest K holds small displacements v that the constraints allow, vᵀK v their work. Where that is negative the point
// is a saddle of the energy, as a slack cable pressed straight between its ends. It is what was asked for if the model
// was drawn on it, as a column drawn straight under a load along its axis: then nothing pushes it off. Where the
// imbalance of the drawn point does work along such v, a motion from there goes down on the other side.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "analysis/static_equations.h"

namespace dynalin {

// A step off the saddle, down the way that the imbalance of `drawn` pushes, of a hundredth of a radian and of the
// model's length; nothing if the point is no saddle, or nothing pushes. Forces that have no energy, and models that are
// large, are left as they are.
std::optional<Eigen::VectorXd> step_off_saddle(StaticEquations&, const OperatingPoint& at_rest,
                                               const OperatingPoint& drawn);

}  // namespace dynalin

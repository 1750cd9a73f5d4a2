// The exact linear model of a system at an operating point: the perturbation equations (perturb.h) reduced to chosen
// coordinates.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/initial.h"
#include "perturbation/perturb.h"

namespace dynalin {

class StructuralZeros;

// How far a unit of a state moves anything: a coordinate displacements, a rate velocities, in lengths of the model and
// radians.
struct StateReach {
  double size = 0;
  std::int32_t coordinate = -1;  // that moves so far, −1 if nothing does
};

// The perturbation equations with their state matrices.
struct LinearSystem : Perturbation {
  Eigen::MatrixXd A;         // as computed; in the model, entries that are nothing but rounding are zero
  Eigen::MatrixXd rounding;  // what the entries of A may carry of rounding, element by element
  // What A is not known to, by roundings of coefficients and near singular configurations of velocities.
  Eigen::MatrixXd uncertainty;
  Eigen::MatrixXd beside_coefficients;  // the part of it that does not come of the pencil's coefficients, if any
  std::vector<StateReach> reach;        // of every state
  std::vector<std::int32_t> left_out;   // constraint rows that depend on others
  std::shared_ptr<const StructuralZeros> structural_zeros;
  // Whose eigenvalues are those of A: the equations, unless the original implementation leaves a block of A out.
  std::shared_ptr<const PerturbationEquations> pencil;
};

// Forms A, B, C and D.
Result<LinearSystem> reduce(const System&, Perturbation);
// The equations for who takes no more than what elements contribute to them.
Result<LinearSystem> linearize_unreduced(const System&, OperatingPoint, const LinearOptions&);
// Both. Refused where the roundings of the point alone decide the state matrix, with a warning where they leave few
// digits of it. A model of more than `up_to` states remains an operator without state matrix, unless that alone tells
// whether it has a linear model: where freedoms without mass move.
Result<LinearSystem> linearize(const System&, OperatingPoint, const LinearOptions&,
                               std::size_t up_to = std::numeric_limits<std::size_t>::max());

}  // namespace dynalin

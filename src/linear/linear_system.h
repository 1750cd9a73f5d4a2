// The exact linear model of a system at an operating point: the perturbation equations (perturbation.h) reduced to
// chosen coordinates (state_choice.h).
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/initial.h"
#include "dynalin/results.h"

namespace dynalin {

struct LinearOptions {
  std::optional<ElementHandle> pstate, pinput, poutput;
  MarkerId rm;                   // not valid: global coordinates
  bool without_damping = false;  // NODAMPIN
  // Of the original implementation (LINEAR command, 5.1.12):
  bool principal_states = false;       // mass centres and 3-1-3 angles of principal axes
  bool without_rate_coupling = false;  // with without_damping: differential states see no rates
};

class PerturbationEquations;
class StructuralZeros;

// How far the constraint rows and chosen coordinates are from depending on each other (configuration.h).
struct NearSingularity {
  double distance = 1;
  std::vector<std::string> rows;
};

struct PerturbedPoint;

// How far a unit of a state moves anything: a coordinate displacements, a rate velocities, in lengths of the model and
// radians.
struct StateReach {
  double size = 0;
  std::int32_t coordinate = -1;  // that moves so far, −1 if nothing does
};

// The perturbation equations of a model at a point and what their states are called: an operator, with nothing dense of
// the size of the model.
struct Perturbation {
  StateSpace model;  // states, inputs and outputs; its matrices come from reduce()
  std::size_t kinematic_states = 0, differential_states = 0;
  std::size_t first_order = 0;          // coordinates without mass whose rate is no state
  bool has_massless_states = false;     // some coordinates or rates follow from balances of forces without inertia
  std::vector<StateLabel> coordinates;  // the chosen ones, in order
  std::vector<double> scales;           // of states: how much of a coordinate compares with the length of the model and
                                        // a radian; 0 for rates, differential states and what may have any size
  bool principal_states = false;        // those of the original implementation are in force
  NearSingularity near_singularity;
  Diagnostics warnings;
  std::shared_ptr<const PerturbationEquations> equations;
  std::shared_ptr<const PerturbedPoint> at;  // what they were made of

  // What columns of states do to all coordinates of the layout, and to their rates.
  Eigen::MatrixXcd displacements(const Eigen::MatrixXcd& of_states) const;
  Eigen::MatrixXcd velocities(const Eigen::MatrixXcd& of_states) const;
};

// The same with its state matrices.
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

// The equations, without the state matrix. The point must be consistent on all levels (solve_acceleration).
Result<Perturbation> perturb(const System&, const OperatingPoint&, const LinearOptions&);
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

// The linear model as an operator: perturbation equations (perturbation.h) of states that were chosen (state_choice.h).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "analysis/initial.h"
#include "dynalin/results.h"
#include "states/linear_options.h"
#include "states/near_singularity.h"

namespace dynalin {

class PerturbationEquations;
struct PerturbedPoint;

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
  Eigen::MatrixXcd displacements(const Eigen::Ref<const Eigen::MatrixXcd>& of_states) const;
  Eigen::MatrixXcd velocities(const Eigen::Ref<const Eigen::MatrixXcd>& of_states) const;
};

// The equations, without the state matrix. The point must be consistent on all levels (solve_acceleration).
Result<Perturbation> perturb(const System&, const OperatingPoint&, const LinearOptions&);

}  // namespace dynalin

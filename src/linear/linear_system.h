// The exact linear model of a system at an operating point: the perturbation equations (perturbation.h) reduced to
// chosen coordinates (state_choice.h).
#pragma once

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

struct LinearSystem {
  StateSpace model;
  std::size_t kinematic_states = 0, differential_states = 0;
  std::vector<StateLabel> coordinates;  // the chosen ones, in order
  std::vector<std::string> warnings;
  // Columns of states, then inputs: variations of all coordinates, rates, accelerations, multipliers, algebraic values.
  Eigen::MatrixXd dq, dqdot, dqddot, dlambda, dw;
  Eigen::MatrixXd rounding;  // what the entries of A may carry of rounding, element by element
  std::shared_ptr<const PerturbationEquations> equations;
};

// The point must be consistent on all levels (solve_acceleration).
Result<LinearSystem> linearize(const System&, OperatingPoint, const LinearOptions&);

}  // namespace dynalin

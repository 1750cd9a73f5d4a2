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
class StructuralZeros;

// How far the constraint rows and chosen coordinates are from depending on each other (configuration.h).
struct NearSingularity {
  double distance = 1;
  std::vector<std::string> rows;
};

struct LinearSystem {
  StateSpace model;
  std::size_t kinematic_states = 0, differential_states = 0;
  std::size_t first_order = 0;          // coordinates without mass whose rate is no state
  bool has_massless_states = false;     // some coordinates or rates follow from balances of forces without inertia
  std::vector<StateLabel> coordinates;  // the chosen ones, in order
  std::vector<double> scales;           // of states: how much of a coordinate compares with the length of the model and
                                        // a radian; 0 for rates, differential states and what may have any size
  bool principal_states = false;        // those of the original implementation are in force
  Diagnostics warnings;
  // Columns of states, then inputs: variations of all coordinates, rates, accelerations, multipliers, algebraic values.
  Eigen::MatrixXd dq, dqdot, dqddot, dlambda, dw;
  Eigen::MatrixXd A;         // as computed; in the model, entries that are nothing but rounding are zero
  Eigen::MatrixXd rounding;  // what the entries of A may carry of rounding, element by element
  // What roundings of the velocities make of A near singular configurations, element by element; else empty.
  Eigen::MatrixXd uncertainty;
  std::shared_ptr<const StructuralZeros> structural_zeros;
  NearSingularity near_singularity;
  std::shared_ptr<const PerturbationEquations> equations;
};

// The point must be consistent on all levels (solve_acceleration). Refused where its roundings alone decide the state
// matrix, with a warning where they leave few digits of it.
Result<LinearSystem> linearize(const System&, OperatingPoint, const LinearOptions&);

}  // namespace dynalin

// The perturbation equations of a model at an operating point, reduced to chosen coordinates.
//
// With δq = the path variation of all coordinates and x the chosen ones, three levels are solved with the same rows:
//
//     [G; X] δq  = [0; δx]
//     [G; X] δq′ = [−G′ δq; δx′ − X′ δq]
//     saddle (δq″, δλ, δw, δz′) = −(∂/∂q δq + ∂/∂q′ δq′ + ∂/∂z δz), constraint rows −(a1 δq′ + a0 δq)
//
// and δx″ = X δq″ + 2 X′ δq′ + X″ δq. Velocity rows make the second level larger: fewer rates than coordinates.
#pragma once

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

// A coordinate that may become a state: its gradient along the motion and its name.
struct Candidate {
  std::int32_t coordinate = -1;  // a coordinate of the layout itself, or
  std::int32_t row = -1;         // a row of gradients (RM, PSTATE)
  StateLabel label;
};

struct LinearSystem {
  StateSpace model;
  std::size_t kinematic_states = 0, differential_states = 0;
  std::vector<StateLabel> coordinates;  // the chosen ones, in order
  std::vector<std::string> warnings;
  // Columns of states, then inputs: variations of all coordinates, rates, accelerations, multipliers, algebraic values.
  Eigen::MatrixXd dq, dqdot, dqddot, dlambda, dw;
};

// The point must be consistent on all levels (solve_acceleration).
Result<LinearSystem> linearize(const System&, OperatingPoint, const LinearOptions&);

}  // namespace dynalin

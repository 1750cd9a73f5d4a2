// Coordinates that may become states, beyond the global ones: relative to a marker (RM), the user's own (PSTATE), or
// those of the original implementation (original_states.h).
#pragma once

#include "analysis/initial.h"
#include "dynalin/results.h"
#include "mechanics/bound_expression.h"
#include "states/linear_options.h"

namespace dynalin {

// How a coordinate and its rate are listed as states.
struct StateCoordinate {
  StateLabel label, rate;
  double scale = 0;  // how much of it compares with the length of the model and a radian; 0: it may have any size
};

// The rate is listed with its own type and number.
StateCoordinate state_coordinate(StateLabel, StateType rate_type, int rate_number, double scale);

// Coordinate k of a body along the global axes.
StateCoordinate global_coordinate(const System&, const BodyBlock&, std::int32_t k);

// A coordinate that may become a state: its gradient along the motion and its name.
struct Candidate {
  std::int32_t coordinate = -1;  // a coordinate of the layout itself, or
  std::int32_t row = -1;         // a row of gradients (RM, PSTATE, principal coordinates)
  StateCoordinate state;
};

// Candidates in the order in which they are wanted, with the gradient rows of those that are no plain coordinate.
struct CandidateSet {
  std::vector<Candidate> own;       // PSTATE
  std::vector<Candidate> wanted;    // RM, principal or global coordinates
  std::vector<Candidate> fallback;  // global coordinates while RM is in force
  ConstraintRows gradients;
  // Where the wanted ones are a change of coordinates of the layout: how a unit of each moves those. Empty otherwise.
  using Moves = std::vector<std::pair<std::int32_t, double>>;
  std::vector<Moves> moves;
  Diagnostics warnings;
};

Result<CandidateSet> state_candidates(const System&, const Motion&, const LinearOptions&);

}  // namespace dynalin

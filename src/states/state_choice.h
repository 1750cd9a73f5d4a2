// Which coordinates and rates become states, and which constraint rows hold the others.
//
// The rows of constraints take pivots first among coordinates that are wanted least; what is left over is independent.
// Velocity rows then take some of the rates away: such a coordinate is a state without its rate. So do freedoms without
// mass (massless_states.h), which may take positions as well.
#pragma once

#include <optional>

#include "base/time_taylor.h"
#include "states/candidates.h"
#include "system/sparse_lu.h"

namespace dynalin {

// Rows on positions that depend on others to rounding or nearly so, and the largest part of their size that was left.
struct RedundantRows {
  std::vector<std::int32_t> rows;
  double left = 0;
};

struct StateChoice {
  using Entry = ConstraintRows::Entry;       // of the gradient of a chosen coordinate
  std::vector<StateCoordinate> coordinates;  // the chosen ones, in the order in which they are wanted
  std::vector<std::vector<Entry>> gradient;  // x = gradient · q, along the motion
  // x with its rate and acceleration at the point, of a coordinate of the user: TIME may move it as well.
  std::vector<std::optional<Taylor>> along_motion;
  std::vector<bool> has_position;             // whether x is a state; without mass its forces may determine it
  std::vector<bool> has_rate;                 // whether x′ is a state as well
  std::vector<bool> active, velocity_active;  // rows that hold positions, and rates
  std::optional<RedundantRows> redundant;     // where the default coordinates were those to choose from
  // Places in the list of states.
  std::vector<std::int32_t> position_state, rate_state;  // of chosen coordinates; −1 for what is no state
  std::vector<std::int32_t> differential;                // differential state k of the list is state differential[k]
  std::int32_t first_differential = 0;
  std::vector<StateLabel> states;  // all, as listed: rate before coordinate, then differential states
  std::vector<double> scales;      // StateCoordinate::scale of those that are coordinates, 0 for all others
  Diagnostics warnings;

  std::int32_t size() const { return static_cast<std::int32_t>(states.size()); }
  bool splits_unequally() const;  // fewer rates than coordinates, or other rows
};

// The matrix of one level: constraint rows that are active, then the gradients of chosen coordinates that are used;
// `square` says whether they determine a motion, with as many rows beyond them as are left `vacant` at the end.
ColumnMatrix level_matrix(const ConstraintRows&, const StateChoice&, const std::vector<bool>& active,
                          const std::vector<bool>& used, bool& square, std::int32_t vacant = 0);
Failure undetermined_positions();

// Fills in the list of states and their places.
void list_states(const Layout&, StateChoice&);

Result<StateChoice> choose_states(const System&, const Motion&, const ConstraintRows&, const LinearOptions&);

}  // namespace dynalin

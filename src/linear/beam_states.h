// Coordinates of beams as states: position, rotation and slope of each node, global axes, numbered node by node, then
// the rotations between nodes. A reference marker has no influence on them.
#pragma once

#include <map>

#include "linear/candidates.h"

namespace dynalin {

// By coordinate of the layout.
std::map<std::int32_t, StateCoordinate> beam_state_coordinates(const System&);

}  // namespace dynalin

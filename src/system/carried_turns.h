// Turns that one system has counted, for the angles of another.
#pragma once

#include <map>
#include <vector>

#include "system/system.h"

namespace dynalin {

using KnownTurns = std::map<AngleName, double>;  // the angles with all their turns
KnownTurns known_turns(const System&, const OperatingPoint&);

// Puts them into the memory of a point that has its poses. An angle that is not known takes its turns from one about
// the same axis of the same two bodies, from which it differs by what it differed as drawn; where there is none it
// begins at the point, within half a turn. Returns the names of these.
std::vector<AngleName> take_over_turns(const KnownTurns&, const System&, OperatingPoint&);

}  // namespace dynalin

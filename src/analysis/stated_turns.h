// Whole turns of joints at the start.
#pragma once

#include "model/restated.h"
#include "system/system.h"

namespace dynalin {

// Takes the turns into the memory that a restated IC of a joint or MOTION says its angle has, and those of joints that
// COUPLER and GEAR lead with it. Angles of which nothing is stated go on from those of the point.
void take_stated_turns(const System&, const Restated&, OperatingPoint&);

}  // namespace dynalin

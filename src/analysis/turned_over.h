// Whether a search has turned a joint over: constraints that hold axes in line are met by opposite ones, too, and no
// motion of the mechanism leads from one to the other.
#pragma once

#include "system/system.h"

namespace dynalin {

// The first element whose markers point the other way than they did, or null.
const ElementLabel* turned_over(const System&, const OperatingPoint& from, const OperatingPoint& to);

}  // namespace dynalin

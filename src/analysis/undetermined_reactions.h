// Elements that read reactions which nothing determines: where constraints are redundant, the equations do not say how
// they share their load, and the rows that are kept bear it, which the order of the statements decides.
#pragma once

#include "analysis/acceleration_equations.h"

namespace dynalin {

// A warning for each element whose algebraic or differential equations would say something else by the least reactions
// that balance the same; of a model too large to look at, one warning that says so. The equations are left at these.
void warn_of_undetermined_reactions(const System&, AccelerationEquations&, const OperatingPoint&, Diagnostics&);

}  // namespace dynalin

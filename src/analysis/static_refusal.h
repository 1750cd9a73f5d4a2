// Why no equilibrium was found, in words.
#pragma once

#include <string>
#include <vector>

#include "analysis/static_equations.h"

namespace dynalin {

// Parts that hold on to each other but not to ground along some direction in which forces act on them: whatever their
// pose, the sum of these forces stays. One sentence for every such group, none if everything is held.
std::vector<std::string> unheld_parts(StaticEquations&, const OperatingPoint&);

// At a point that is not at rest; `proof`: sentences that say why there is no equilibrium at all.
Failure static_refusal(StaticEquations&, OperatingPoint, const std::vector<std::string>& proof,
                       std::vector<std::string> history);

}  // namespace dynalin

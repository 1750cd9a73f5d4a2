// Newton steps of least change from one point onto the constraint rows of positions.
#pragma once

#include <vector>

#include "analysis/initial.h"

namespace dynalin {

// Where the parameters of open curves may go: on along the tangents there, or not beyond the ends.
enum class Ends : bool { passed, kept };

// Which displacements that elements ask of the start hold, in their order; empty where none does.
using HeldStarts = std::vector<bool>;

// `held` coordinates stay; where it is empty none has to. Fails where constraints contradict each other, have no finite
// value, or are not met after as many steps as IC allows.
Result<OperatingPoint> assemble(const System&, OperatingPoint from, const HeldStarts&, Ends, const Progress& = {},
                                const std::vector<bool>& held = {});

}  // namespace dynalin

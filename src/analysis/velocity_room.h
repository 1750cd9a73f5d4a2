// What of the stated velocities the constraints leave no room for: along a bar from its hinge, across a guide.
#pragma once

#include <vector>

#include "analysis/velocity_conditions.h"

namespace dynalin {

// Takes those out of the conditions, constraints first, of which the constraints leave next to nothing; returns them.
std::vector<VelocityCondition> take_without_room(const System&, const Motion&, const ConstraintRows&,
                                                 std::vector<VelocityCondition>&);

}  // namespace dynalin

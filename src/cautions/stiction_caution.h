// Joints that friction holds at the point: their stiffness may make modes that the model does not have once they slide
// (LINEAR command, "Advanced eigensolution issues").
#pragma once

#include "linear/linear_system.h"

namespace dynalin {

// Adds a warning for each, with the mode that has most of its energy in the bristles of the joint.
void stiction_cautions(const System&, const OperatingPoint&, const LinearSystem&, const EigenSolution&, Diagnostics&);

}  // namespace dynalin

// Flexible bodies where their linear modes are no longer what a real body does: turning fast, or bent far.
#pragma once

#include "system/system.h"

namespace dynalin {

// Adds a warning for each that turns faster than a tenth of its lowest frequency with the BCS held, of which geometric
// stiffening would show, and for each that is bent by more than a tenth of its length or turned within by more than
// ten degrees.
void flexible_cautions(const System&, const OperatingPoint&, Diagnostics&);

}  // namespace dynalin

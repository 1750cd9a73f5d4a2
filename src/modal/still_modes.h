// Modes in which nothing that has mass can move: controllers that drive no body, freedoms of first order without mass.
// Their eigenvectors come with roundings in the entries of bodies, and whatever divides by a mode's mass would take
// these for a motion.
#pragma once

#include "linear/linear_system.h"

namespace dynalin {

// Makes those entries zero. The decision is structural: states that influence no mass but by the rounding of
// coefficients form a system of their own, and the mode must belong to that one.
void clear_still_modes(const System&, const OperatingPoint&, const LinearSystem&, EigenSolution&);

}  // namespace dynalin

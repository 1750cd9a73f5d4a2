// What some routines get as arguments instead of asking for it: those of a FIELD, a CONTACT and a COUPLER. They read
// nothing else, and their derivatives count these inputs in this order.
#pragma once

#include <vector>

#include "routine/compiled_routine.h"

namespace dynalin {

// Behind TIME and MODE.
inline constexpr std::size_t first_given = 2;

// Of the normal force of a CONTACT: LOCI, NI, LOCJ, NJ, three numbers each, GAP and GAPDOT; of its friction: LOCI,
// LOCJ, XDOT and NFORCE.
inline constexpr std::size_t given_to_pressure = 14, given_to_friction = 10;

// Of a COUPLER: DISP, as many as it has joints.
inline constexpr std::size_t most_given_to_coupler = 3;

// Empty for a routine that asks for what it reads.
std::vector<Atom> given_inputs(const RoutineKind&, const RoutineStatement&);

}  // namespace dynalin

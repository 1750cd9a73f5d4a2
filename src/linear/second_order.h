// The second-order form of a state space (LINEAR command, 5.2; MKB):
//
//     M s″ + B s′ + K s = P u,   y = C (s, s′) + D u,   s = (x, z)
//
// with the coordinates x and the differential states z: M = diag(1, 0), and rows of z are of first order. Coordinates
// without mass that are of first order stand between x and z, with rows like those of z.
#pragma once

#include "analysis/initial.h"
#include "dynalin/results.h"

namespace dynalin {

// Refuses a model with velocity constraints, whose coordinates and rates do not pair. `first_order` is how many
// coordinates without mass have no rate.
Result<SecondOrder> second_order(const StateSpace&, std::size_t first_order = 0);

}  // namespace dynalin

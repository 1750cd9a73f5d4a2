// The second-order form of a state space (LINEAR command, 5.2; MKB):
//
//     M s″ + B s′ + K s = P u,   y = C (s, s′) + D u,   s = (x, z)
//
// with the coordinates x and the differential states z: M = diag(1, 0), and rows of z are of first order.
#pragma once

#include "analysis/initial.h"
#include "dynalin/results.h"

namespace dynalin {

// Refuses a model with velocity constraints, whose coordinates and rates do not pair.
Result<SecondOrder> second_order(const StateSpace&);

}  // namespace dynalin

// Motions that forces drive and that nothing opposes, whatever the pose: proof that there is no equilibrium.
//
// A motion y of the parts, with what it does to multipliers, values and states, is opposed by nothing to first order if
// the tangent has zᵀJ = 0 with y in z; the work zᵀr of the imbalance is then constant near the point. The part of r
// that is orthogonal to the columns of J is such a motion, and the only one that matters.
#pragma once

#include <string>
#include <vector>

#include "analysis/static_equations.h"

namespace dynalin {

struct UnheldMotion {
  std::vector<std::size_t> bodies;  // that move
  bool turning = false;
  Vector load;  // along the motion: force, or moment about its axis
};

// At one point: parts that move together are one motion.
std::vector<UnheldMotion> unheld_motions(StaticEquations&, const OperatingPoint&);

// The motions of the first point if every point has motions of the same parts: a sentence for each, else none.
std::vector<std::string> unheld_everywhere(StaticEquations&, const std::vector<OperatingPoint>&);

}  // namespace dynalin

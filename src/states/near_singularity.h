// How far the constraint rows and chosen coordinates are from depending on each other: near singular configurations.
#pragma once

#include <string>
#include <vector>

#include "system/system.h"

namespace dynalin {

struct StateChoice;

struct NearSingularity {
  double distance = 1;
  std::vector<std::string> rows;
};

// The constraint rows and chosen coordinates, each row and each coordinate in its own unit, as a matrix: its least
// singular value, and the rows and coordinates that all but depend on each other there.
NearSingularity near_singularity(const System&, const ConstraintRows&, const StateChoice&);

}  // namespace dynalin

// What moves in an assembly, and what rather stays: the least change that meets the constraints is the least by these.
#pragma once

#include <vector>

#include "system/sparse_lu.h"
#include "system/system.h"

namespace dynalin {

// How a change of each coordinate counts, and what is added to it for the change of angles and for that of neighbours
// against each other.
struct AssemblyWeights {
  std::vector<double> of_coordinates;
  std::vector<Triplet> coupled;
};

// Coordinates that EXACT asks to keep hardly move; `drawn` is where angles are looked at.
AssemblyWeights assembly_weights(const System&, const OperatingPoint& drawn);

}  // namespace dynalin

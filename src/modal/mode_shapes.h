// Motions of the whole model that belong to the eigenvectors of the reduced one.
#pragma once

#include "linear/linear_system.h"

namespace dynalin {

// Fills EigenMode::moves_most from the eigenvectors: the body with the largest share of the kinetic energy; where
// nothing that has mass moves, the controller whose state is largest, or else the body that moves furthest.
void name_movers(const System&, const OperatingPoint&, const LinearSystem&, EigenSolution&);

// Fills EigenSolution::shapes: φ = T z with T the map from states to all coordinates (LINEAR command, "Eigenvectors and
// mode shapes").
void map_shapes(const System&, const LinearSystem&, EigenSolution&);

}  // namespace dynalin

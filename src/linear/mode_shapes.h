// Motions of the whole model that belong to the eigenvectors of the reduced one.
#pragma once

#include "linear/linear_system.h"

namespace dynalin {

// Fills EigenMode::moves_most from the eigenvectors: motions are compared by √(|δr_C|² + L² |δθ|²) with the
// displacement of the mass centre and the model length L.
void name_movers(const System&, const OperatingPoint&, const LinearSystem&, EigenSolution&);

// Fills EigenSolution::shapes: φ = T z with T the map from states to all coordinates (LINEAR command, "Eigenvectors and
// mode shapes").
void map_shapes(const System&, const LinearSystem&, EigenSolution&);

}  // namespace dynalin

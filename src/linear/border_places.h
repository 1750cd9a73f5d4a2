// Where eigenvalues may be that the border of a region passes closely.
#pragma once

#include <complex>
#include <vector>

#include "linear/eigenvalue_search.h"
#include "linear/mode_region.h"

namespace dynalin {

// What stands near the border and is not known, both members of pairs: two of them, passed by closely, turn the phase
// of the determinant by 2π between two points that look alike. The nearest are looked for from where the border passes
// what is known. The operator is left at another shift.
std::vector<std::complex<double>> beside_border(const ModeRegion&, std::vector<std::complex<double>> known,
                                                ShiftInverse&, ModeSearch&);

}  // namespace dynalin

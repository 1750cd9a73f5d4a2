// What computed numbers of the eigensolution are uncertain by.
#pragma once

#include <limits>

namespace dynalin {

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr double upward = 1 + 1e-9;              // covers the rounding of bounds that are sums in double
inline constexpr double upward_from_single = 1 + 1e-6;  // and of sizes kept in single precision
inline constexpr double infinity = std::numeric_limits<double>::infinity();  // of a bound: there is none
// Eigenvalues that differ by no more, relative, and have vectors of their own are equal: any vectors of their space do,
// to this share of the eigenvalue. Those of a chain differ as much, but what couples them is larger.
inline constexpr double equal_values = 1e-9;
// Two ways to the same product err by no more than a few times what they differ, unless both err alike.
inline constexpr double margin_of_difference = 4;

}  // namespace dynalin

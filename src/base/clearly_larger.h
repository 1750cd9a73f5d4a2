// The largest of some numbers, as it names or scales something: of those that are equal but for rounding the first, so
// that what a table says does not depend on roundings.
#pragma once

namespace dynalin {

inline constexpr double equal_entries = 1e-12;   // of a vector, relative
inline constexpr double equal_solutions = 1e-9;  // of what a vector has been solved for and measured

constexpr bool is_clearly_larger(double a, double b, double equal = equal_entries) { return a > b * (1 + equal); }

}  // namespace dynalin

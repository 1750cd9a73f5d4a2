// Which printed numbers promise more digits than the error bound of the value holds.
#pragma once

#include <cmath>

namespace dynalin {

// Whether a part of an eigenvalue printed with so many digits is certain to about a unit of the last of them; one that
// is zero, to that of the modulus it is compared with.
inline bool certain(double part, double modulus, double bound, int digits) {
  const double size = part == 0 ? modulus : std::abs(part);
  if (size == 0) return bound == 0;
  return bound <= std::pow(10.0, std::floor(std::log10(size)) - (digits - 1));
}

inline const char* doubt(bool certain) { return certain ? "" : "?"; }

}  // namespace dynalin

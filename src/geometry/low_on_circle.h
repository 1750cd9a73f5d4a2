// Where a circle reaches deepest into a plane: a point of it, if it inclines. One that stands flat is as deep all
// around, and takes what it bears in its middle; up to an inclination ε the place passes from there to the circle:
//
//     depth below the centre   r F(s),      s the sine of the inclination,  F = s beyond ε,
//                                           F = ε (3/8 + 3/4 (s/ε)² − 1/8 (s/ε)⁴) up to there
//     distance from the centre r F′(s)
//
// F has two continuous derivatives and grows as the place moves outwards, so that the force has a potential and rights
// what stands: against an inclination by 3/2 r/ε times itself. A flat circle reaches 3/8 ε r deeper than it is.
#pragma once

#include <cmath>

#include "mechanics/path.h"

namespace dynalin::solid {

inline constexpr double level_inclination = 1e-4;  // ε

template <class T>
struct LowPlace {
  Vec3<T> from_centre;  // along the circle's plane
  T depth{};            // below its centre, across the other plane
  bool level = false;   // not on the circle itself
};

// `down`: what of the unit vector into the plane lies along the plane of the circle.
template <class T>
LowPlace<T> low_on_circle(const Vec3<T>& down, double radius) {
  using std::sqrt;
  constexpr double e = level_inclination;
  const T square = dot(down, down);
  if (value_of(square) >= e * e) {
    const T sine = sqrt(square);
    return {down * (radius / sine), sine * radius};
  }
  const T x = square * (1 / (e * e));
  return {down * ((1.5 - 0.5 * x) * (radius / e)), (0.375 + 0.75 * x - 0.125 * x * x) * (radius * e), radius > 0};
}

}  // namespace dynalin::solid

// What two bodies exert on each other where they overlap: pressure along the normal and friction across it.
//
//     N = max(0, k g^e + STEP(g, 0, 0, d, c) g′)      g > 0: the penetration, g′ its rate
//     F = −μ(|v|) N v/|v|                              v: the velocity of I's material seen from J's, across the normal
//
// μ is an odd function of the slip speed, cubic pieces: 0 at rest, μ_s at v_s, μ_d from v_d on. It is written as |v|
// times an even function, so that it has all its derivatives at rest.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/dual.h"
#include "base/smooth_step.h"
#include "base/vec3.h"

namespace dynalin {

struct Pressure {
  double stiffness = 0;     // k [force/length^e]
  double exponent = 1;      // e ≥ 1
  double damping = 0;       // c [force·time/length]
  double full_damping = 0;  // d [length]: the penetration from which the whole of c acts; 0: always
};

struct SlipFriction {
  double at_rest = 0, sliding = 0;      // μ_s, μ_d
  double stiction = 0, transition = 0;  // v_s < v_d [length/time]
};

// Before it is cut off at zero.
template <class T>
T pressure(const Pressure& p, const T& g, const T& rate) {
  using std::pow;
  const T share = value_of(g) < p.full_damping ? smooth_step(T(g * (1 / p.full_damping))) : T(1.0);
  return p.stiffness * pow(g, p.exponent) + p.damping * share * rate;
}

// μ(|v|)/|v|
template <class T>
T friction_slope(const SlipFriction& f, const Vec3<T>& slip) {
  using std::sqrt;
  const T square = dot(slip, slip);
  const double speed = std::sqrt(value_of(square));
  if (speed < f.stiction) return (3.0 - square * (1 / (f.stiction * f.stiction))) * (0.5 * f.at_rest / f.stiction);
  const T v = sqrt(square);
  if (speed >= f.transition) return f.sliding / v;
  const T s = (v - f.stiction) * (1 / (f.transition - f.stiction));
  return (f.at_rest + (f.sliding - f.at_rest) * smooth_step(s)) / v;
}

}  // namespace dynalin

// Transitions from h0 at x0 to h1 at x1, which other functions use too.
//
// With s = (x − x0)/(x1 − x0): h0 for s ≤ 0, h1 for s ≥ 1, h0 + (h1 − h0) shape(s) between. So a
// step with x1 < x0 runs from right to left. At both ends the constant side is used. With x0 = x1
// there is no value.
#pragma once

#include "expression/functions_define.h"

namespace dynalin::steps {

template <class T, class Shape>
T between(const T& x, const T& x0, const T& h0, const T& x1, const T& h1, Shape shape) {
  if (value_of(x0) == value_of(x1)) return undefined<T>();
  const T s = (x - x0) / (x1 - x0);
  if (value_of(s) <= 0.0) return h0;
  if (value_of(s) >= 1.0) return h1;
  return h0 + (h1 - h0) * shape(s);
}

// Both ends: a list of arguments that begins with x, x0, h0, x1.
inline void ends(std::span<const double> a, SwitchList& out) {
  out.add(a[0] - a[1]);
  out.add(a[0] - a[3]);
}

// STEP(x, x0, h0, x1, h1): shape s² (3 − 2 s), with continuous slope.
inline constexpr auto cubic = []<class T>(const T& x, const T& x0, const T& h0, const T& x1, const T& h1) {
  return between(x, x0, h0, x1, h1, [](const T& s) { return T(s * s * (3.0 - 2.0 * s)); });
};

// STEP5(x, x0, h0, x1, h1): shape s³ (10 − 15 s + 6 s²), with continuous curvature.
inline constexpr auto quintic = []<class T>(const T& x, const T& x0, const T& h0, const T& x1, const T& h1) {
  return between(x, x0, h0, x1, h1, [](const T& s) { return T(s * s * s * (10.0 - s * (15.0 - 6.0 * s))); });
};

}  // namespace dynalin::steps

// A value with its first and second derivative along one parameter: time along the motion, or a variation.
#pragma once

#include <cmath>

#include "small_algebra.h"

namespace dynalin::oracle {

// A derivative that is not known: beyond all that occurs, so that it spoils what depends on it, and another number each
// time, so that two of them do not cancel. It stays finite in products of a few: extended precision is many times
// slower with NaN on common processors.
inline Real unknown() {
  thread_local Real share = 0;
  share += 0.6180339887498948482L;
  if (share >= 1) share -= 1;
  return 1e1000L * (1 + share);
}
[[nodiscard]] inline bool is_known(Real x) { return std::fabs(x) < 1e500L; }

struct Jet {
  Real v = 0, d = 0, dd = 0;
  Jet() = default;
  Jet(Real value) : v(value) {}  // NOLINT: a constant is a jet
  Jet(Real value, Real first, Real second) : v(value), d(first), dd(second) {}
};

[[nodiscard]] inline Real value_of(Real x) { return x; }
[[nodiscard]] inline Real value_of(const Jet& x) { return x.v; }

[[nodiscard]] inline Jet operator+(const Jet& a, const Jet& b) { return {a.v + b.v, a.d + b.d, a.dd + b.dd}; }
[[nodiscard]] inline Jet operator-(const Jet& a, const Jet& b) { return {a.v - b.v, a.d - b.d, a.dd - b.dd}; }
[[nodiscard]] inline Jet operator-(const Jet& a) { return {-a.v, -a.d, -a.dd}; }
[[nodiscard]] inline Jet operator*(const Jet& a, const Jet& b) {
  return {a.v * b.v, a.d * b.v + a.v * b.d, a.dd * b.v + 2 * a.d * b.d + a.v * b.dd};
}
// By a number, which costs half as much as by a jet.
[[nodiscard]] inline Jet operator*(Real s, const Jet& a) { return {s * a.v, s * a.d, s * a.dd}; }
[[nodiscard]] inline Vector3<Jet> operator*(Real s, const Vector3<Jet>& a) { return {s * a.x, s * a.y, s * a.z}; }
// f(x) from f, f' and f'' at x.
[[nodiscard]] inline Jet chain(const Jet& x, Real f, Real f1, Real f2) {
  return {f, f1 * x.d, f1 * x.dd + f2 * x.d * x.d};
}
[[nodiscard]] inline Jet operator/(const Jet& a, const Jet& b) {
  return a * chain(b, 1 / b.v, -1 / (b.v * b.v), 2 / (b.v * b.v * b.v));
}

[[nodiscard]] inline Jet sin(const Jet& x) { return chain(x, std::sin(x.v), std::cos(x.v), -std::sin(x.v)); }
[[nodiscard]] inline Jet cos(const Jet& x) { return chain(x, std::cos(x.v), -std::sin(x.v), -std::cos(x.v)); }
[[nodiscard]] inline Jet exp(const Jet& x) { return chain(x, std::exp(x.v), std::exp(x.v), std::exp(x.v)); }
[[nodiscard]] inline Jet log(const Jet& x) { return chain(x, std::log(x.v), 1 / x.v, -1 / (x.v * x.v)); }
[[nodiscard]] inline Jet sqrt(const Jet& x) {
  const Real root = std::sqrt(x.v);
  return chain(x, root, 0.5L / root, -0.25L / (root * x.v));
}
[[nodiscard]] inline Jet atan(const Jet& x) {
  const Real s = 1 / (1 + x.v * x.v);
  return chain(x, std::atan(x.v), s, -2 * x.v * s * s);
}
// The angle of the point (x, y): its rate is (x y' - y x') / (x^2 + y^2).
[[nodiscard]] inline Jet atan2(const Jet& y, const Jet& x) {
  const Real s = x.v * x.v + y.v * y.v, n = x.v * y.d - y.v * x.d;
  const Real n1 = x.v * y.dd - y.v * x.dd, s1 = 2 * (x.v * x.d + y.v * y.d);
  return {std::atan2(y.v, x.v), n / s, n1 / s - n * s1 / (s * s)};
}

}  // namespace dynalin::oracle

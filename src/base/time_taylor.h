// A quantity along the motion: its value and its first and second total time derivatives.
//
// Every constraint row, measure and expression is written once, for the value; evaluated on TimeTaylor
// it delivers its rates too. With T = Dual and path variations as seeds (mechanics/path.h) the dual
// parts are the partial derivatives of all three.
//
// A coefficient that is not known, because differentiate() used it up, is NaN and never zero: a
// formula that asks for a derivative it does not have cannot pass unnoticed.
#pragma once

#include <cmath>
#include <limits>

#include "base/dual.h"

namespace dynalin {

template <class T>
struct TimeTaylor;

namespace detail {
template <class T>
TimeTaylor<T> product(const TimeTaylor<T>& a, const TimeTaylor<T>& b) {
  return {a.value * b.value, a.rate * b.value + a.value * b.rate,
          a.acceleration * b.value + 2.0 * (a.rate * b.rate) + a.value * b.acceleration};
}
// The same operations in the same order, each partial in one pass: most of the time of variations goes into products,
// and most of theirs into keeping what stands between.
template <std::size_t N>
TimeTaylor<Dual<N>> product(const TimeTaylor<Dual<N>>& a, const TimeTaylor<Dual<N>>& b) {
  const double a0 = a.value.value, a1 = a.rate.value, a2 = a.acceleration.value;
  const double b0 = b.value.value, b1 = b.rate.value, b2 = b.acceleration.value;
  TimeTaylor<Dual<N>> r;
  r.value.value = a0 * b0;
  r.rate.value = a1 * b0 + a0 * b1;
  r.acceleration.value = a2 * b0 + 2.0 * (a1 * b1) + a0 * b2;
  for (std::size_t k = 0; k < N; ++k) {
    const double p0 = a.value.partial[k], p1 = a.rate.partial[k], p2 = a.acceleration.partial[k];
    const double q0 = b.value.partial[k], q1 = b.rate.partial[k], q2 = b.acceleration.partial[k];
    r.value.partial[k] = p0 * b0 + a0 * q0;
    r.rate.partial[k] = (p1 * b0 + a1 * q0) + (p0 * b1 + a0 * q1);
    r.acceleration.partial[k] = (p2 * b0 + a2 * q0) + 2.0 * (p1 * b1 + a1 * q1) + (p0 * b2 + a0 * q2);
  }
  return r;
}
}  // namespace detail

template <class T>
struct TimeTaylor {
  T value{};
  T rate{};
  T acceleration{};

  TimeTaylor() = default;
  TimeTaylor(double constant) : value(constant), rate(0.0), acceleration(0.0) {}  // NOLINT
  TimeTaylor(const T& v, const T& r, const T& a) : value(v), rate(r), acceleration(a) {}

  TimeTaylor& operator+=(const TimeTaylor& b) {
    value += b.value, rate += b.rate, acceleration += b.acceleration;
    return *this;
  }
  TimeTaylor& operator-=(const TimeTaylor& b) {
    value -= b.value, rate -= b.rate, acceleration -= b.acceleration;
    return *this;
  }
  TimeTaylor& operator*=(double b) {
    value *= b, rate *= b, acceleration *= b;
    return *this;
  }
  TimeTaylor& operator*=(const TimeTaylor& b) { return *this = *this * b; }

  friend TimeTaylor operator+(TimeTaylor a, const TimeTaylor& b) { return a += b; }
  friend TimeTaylor operator-(TimeTaylor a, const TimeTaylor& b) { return a -= b; }
  friend TimeTaylor operator-(TimeTaylor a) { return a *= -1.0; }
  friend TimeTaylor operator+(TimeTaylor a, double b) {
    a.value += b;
    return a;
  }
  friend TimeTaylor operator+(double a, TimeTaylor b) { return b + a; }
  friend TimeTaylor operator-(TimeTaylor a, double b) {
    a.value -= b;
    return a;
  }
  friend TimeTaylor operator-(double a, const TimeTaylor& b) { return -b + a; }
  friend TimeTaylor operator*(TimeTaylor a, double b) { return a *= b; }
  friend TimeTaylor operator*(double a, TimeTaylor b) { return b *= a; }
  friend TimeTaylor operator/(TimeTaylor a, double b) { return a *= 1.0 / b; }
  friend TimeTaylor operator*(const TimeTaylor& a, const TimeTaylor& b) { return detail::product(a, b); }
  friend TimeTaylor operator/(const TimeTaylor& a, const TimeTaylor& b) {
    const T inverse = 1.0 / b.value;
    const T v = a.value * inverse;
    const T r = (a.rate - v * b.rate) * inverse;
    return {v, r, (a.acceleration - 2.0 * (r * b.rate) - v * b.acceleration) * inverse};
  }
  friend TimeTaylor operator/(double a, const TimeTaylor& b) { return TimeTaylor(a) / b; }

  friend bool operator<(const TimeTaylor& a, const TimeTaylor& b) { return value_of(a.value) < value_of(b.value); }
  friend bool operator>(const TimeTaylor& a, const TimeTaylor& b) { return b < a; }
  friend bool operator<=(const TimeTaylor& a, const TimeTaylor& b) { return !(b < a); }
  friend bool operator>=(const TimeTaylor& a, const TimeTaylor& b) { return !(a < b); }
};

template <class T>
double value_of(const TimeTaylor<T>& x) {
  return value_of(x.value);
}

namespace detail {
inline double missing(double) { return std::numeric_limits<double>::quiet_NaN(); }
template <std::size_t N, class T>
Dual<N, T> missing(const Dual<N, T>&) {
  Dual<N, T> r(missing(T()));
  r.partial.fill(missing(T()));
  return r;
}

// f(x) along the motion from f and its first two derivatives at x₀.
template <class T>
TimeTaylor<T> chain(const TimeTaylor<T>& x, const T& f, const T& d1, const T& d2) {
  return {f, d1 * x.rate, d2 * (x.rate * x.rate) + d1 * x.acceleration};
}
}  // namespace detail

// The time derivative; its own second derivative is unknown.
template <class T>
TimeTaylor<T> differentiate(const TimeTaylor<T>& x) {
  return {x.rate, x.acceleration, detail::missing(T())};
}

template <class T>
TimeTaylor<T> sqrt(const TimeTaylor<T>& x) {
  using std::sqrt;
  const T f = sqrt(x.value);
  const T d1 = 0.5 / f;
  return detail::chain(x, f, d1, T(-0.5 * d1 / x.value));
}
template <class T>
TimeTaylor<T> sin(const TimeTaylor<T>& x) {
  using std::cos, std::sin;
  const T s = sin(x.value), c = cos(x.value);
  return detail::chain(x, s, c, T(-s));
}
template <class T>
TimeTaylor<T> cos(const TimeTaylor<T>& x) {
  using std::cos, std::sin;
  const T s = sin(x.value), c = cos(x.value);
  return detail::chain(x, c, T(-s), T(-c));
}
template <class T>
TimeTaylor<T> tan(const TimeTaylor<T>& x) {
  using std::tan;
  const T f = tan(x.value);
  const T d1 = 1.0 + f * f;
  return detail::chain(x, f, d1, T(2.0 * f * d1));
}
template <class T>
TimeTaylor<T> asin(const TimeTaylor<T>& x) {
  using std::asin, std::sqrt;
  const T d1 = 1.0 / sqrt(1.0 - x.value * x.value);
  return detail::chain(x, T(asin(x.value)), d1, T(x.value * d1 * d1 * d1));
}
template <class T>
TimeTaylor<T> acos(const TimeTaylor<T>& x) {
  using std::acos, std::sqrt;
  const T d1 = 1.0 / sqrt(1.0 - x.value * x.value);
  return detail::chain(x, T(acos(x.value)), T(-d1), T(-(x.value * d1 * d1 * d1)));
}
template <class T>
TimeTaylor<T> atan(const TimeTaylor<T>& x) {
  using std::atan;
  const T d1 = 1.0 / (1.0 + x.value * x.value);
  return detail::chain(x, T(atan(x.value)), d1, T(-2.0 * x.value * d1 * d1));
}
template <class T>
TimeTaylor<T> sinh(const TimeTaylor<T>& x) {
  using std::cosh, std::sinh;
  const T s = sinh(x.value), c = cosh(x.value);
  return detail::chain(x, s, c, s);
}
template <class T>
TimeTaylor<T> cosh(const TimeTaylor<T>& x) {
  using std::cosh, std::sinh;
  const T s = sinh(x.value), c = cosh(x.value);
  return detail::chain(x, c, s, c);
}
template <class T>
TimeTaylor<T> tanh(const TimeTaylor<T>& x) {
  using std::tanh;
  const T f = tanh(x.value);
  const T d1 = 1.0 - f * f;
  return detail::chain(x, f, d1, T(-2.0 * f * d1));
}
template <class T>
TimeTaylor<T> exp(const TimeTaylor<T>& x) {
  using std::exp;
  const T f = exp(x.value);
  return detail::chain(x, f, f, f);
}
template <class T>
TimeTaylor<T> log(const TimeTaylor<T>& x) {
  using std::log;
  const T d1 = 1.0 / x.value;
  return detail::chain(x, T(log(x.value)), d1, T(-d1 * d1));
}
template <class T>
TimeTaylor<T> log10(const TimeTaylor<T>& x) {
  return log(x) * 0.43429448190325182765;
}
template <class T>
TimeTaylor<T> atan2(const TimeTaylor<T>& y, const TimeTaylor<T>& x) {
  using std::atan2;
  // a′ = (x y′ − y x′)/ρ with ρ = x² + y²; one more derivative of the same quotient.
  const T inverse = 1.0 / (x.value * x.value + y.value * y.value);
  const T rate = (x.value * y.rate - y.value * x.rate) * inverse;
  const T growth = 2.0 * (x.value * x.rate + y.value * y.rate);
  return {T(atan2(y.value, x.value)), rate,
          (x.value * y.acceleration - y.value * x.acceleration - growth * rate) * inverse};
}
template <class T>
TimeTaylor<T> pow(const TimeTaylor<T>& x, double n) {
  using std::pow;
  const T d1 = n == 0.0 ? T(0.0) : T(n * pow(x.value, n - 1.0));
  const T d2 = n == 0.0 || n == 1.0 ? T(0.0) : T(n * (n - 1.0) * pow(x.value, n - 2.0));
  return detail::chain(x, T(pow(x.value, n)), d1, d2);
}

}  // namespace dynalin

// Dual numbers: a value and N partial derivatives, on the stack.
//
// With x = x₀ + Σ xₖ εₖ and εₖ εₗ = 0, every formula evaluated on Dual returns its value and its exact
// partial derivatives. T is double, or again a Dual for exact second derivatives.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace dynalin {

template <std::size_t N, class T = double>
struct Dual {
  T value{};
  std::array<T, N> partial{};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: numbers mix freely with duals
  template <class U = T>
  requires(!std::is_same_v<U, double>) explicit Dual(const U& constant) : value(constant) {}
  Dual(const T& v, std::size_t seed) : value(v) { partial[seed] = T(1.0); }

  Dual& operator+=(const Dual& b) {
    value += b.value;
    for (std::size_t k = 0; k < N; ++k) partial[k] += b.partial[k];
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    value -= b.value;
    for (std::size_t k = 0; k < N; ++k) partial[k] -= b.partial[k];
    return *this;
  }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator*=(double b) {
    value *= b;
    for (auto& p : partial) p *= b;
    return *this;
  }

  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator-(Dual a) { return a *= -1.0; }
  friend Dual operator+(Dual a, double b) {
    a.value += b;
    return a;
  }
  friend Dual operator+(double a, Dual b) { return b + a; }
  friend Dual operator-(Dual a, double b) {
    a.value -= b;
    return a;
  }
  friend Dual operator-(double a, const Dual& b) { return -b + a; }
  friend Dual operator*(Dual a, double b) { return a *= b; }
  friend Dual operator*(double a, Dual b) { return b *= a; }
  friend Dual operator/(Dual a, double b) { return a *= 1.0 / b; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual r;
    r.value = a.value * b.value;
    for (std::size_t k = 0; k < N; ++k) r.partial[k] = a.partial[k] * b.value + a.value * b.partial[k];
    return r;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual r;
    const T inverse = T(1.0) / b.value;
    r.value = a.value * inverse;
    for (std::size_t k = 0; k < N; ++k) r.partial[k] = (a.partial[k] - r.value * b.partial[k]) * inverse;
    return r;
  }
  friend Dual operator/(double a, const Dual& b) { return Dual(a) / b; }
};

// The plain number inside any nesting; comparisons and branches look at it alone.
inline double value_of(double x) { return x; }
template <std::size_t N, class T>
double value_of(const Dual<N, T>& x) {
  return value_of(x.value);
}

template <std::size_t N, class T>
bool operator<(const Dual<N, T>& a, const Dual<N, T>& b) {
  return value_of(a) < value_of(b);
}
template <std::size_t N, class T>
bool operator>(const Dual<N, T>& a, const Dual<N, T>& b) {
  return value_of(a) > value_of(b);
}
template <std::size_t N, class T>
bool operator<=(const Dual<N, T>& a, const Dual<N, T>& b) {
  return value_of(a) <= value_of(b);
}
template <std::size_t N, class T>
bool operator>=(const Dual<N, T>& a, const Dual<N, T>& b) {
  return value_of(a) >= value_of(b);
}

namespace detail {
// f(x) for a dual, from the value f(x₀) and the slope f′(x₀).
template <std::size_t N, class T>
Dual<N, T> chain(const Dual<N, T>& x, const T& f, const T& slope) {
  Dual<N, T> r;
  r.value = f;
  for (std::size_t k = 0; k < N; ++k) r.partial[k] = slope * x.partial[k];
  return r;
}
}  // namespace detail

template <std::size_t N, class T>
Dual<N, T> sqrt(const Dual<N, T>& x) {
  using std::sqrt;
  const T f = sqrt(x.value);
  return detail::chain(x, f, 0.5 / f);
}
template <std::size_t N, class T>
Dual<N, T> sin(const Dual<N, T>& x) {
  using std::cos, std::sin;
  return detail::chain(x, T(sin(x.value)), T(cos(x.value)));
}
template <std::size_t N, class T>
Dual<N, T> cos(const Dual<N, T>& x) {
  using std::cos, std::sin;
  return detail::chain(x, T(cos(x.value)), T(-sin(x.value)));
}
template <std::size_t N, class T>
Dual<N, T> tan(const Dual<N, T>& x) {
  using std::tan;
  const T f = tan(x.value);
  return detail::chain(x, f, T(1.0 + f * f));
}
template <std::size_t N, class T>
Dual<N, T> asin(const Dual<N, T>& x) {
  using std::asin, std::sqrt;
  return detail::chain(x, T(asin(x.value)), T(1.0 / sqrt(1.0 - x.value * x.value)));
}
template <std::size_t N, class T>
Dual<N, T> acos(const Dual<N, T>& x) {
  using std::acos, std::sqrt;
  return detail::chain(x, T(acos(x.value)), T(-1.0 / sqrt(1.0 - x.value * x.value)));
}
template <std::size_t N, class T>
Dual<N, T> atan(const Dual<N, T>& x) {
  using std::atan;
  return detail::chain(x, T(atan(x.value)), T(1.0 / (1.0 + x.value * x.value)));
}
template <std::size_t N, class T>
Dual<N, T> sinh(const Dual<N, T>& x) {
  using std::cosh, std::sinh;
  return detail::chain(x, T(sinh(x.value)), T(cosh(x.value)));
}
template <std::size_t N, class T>
Dual<N, T> cosh(const Dual<N, T>& x) {
  using std::cosh, std::sinh;
  return detail::chain(x, T(cosh(x.value)), T(sinh(x.value)));
}
template <std::size_t N, class T>
Dual<N, T> tanh(const Dual<N, T>& x) {
  using std::tanh;
  const T f = tanh(x.value);
  return detail::chain(x, f, T(1.0 - f * f));
}
template <std::size_t N, class T>
Dual<N, T> exp(const Dual<N, T>& x) {
  using std::exp;
  const T f = exp(x.value);
  return detail::chain(x, f, f);
}
template <std::size_t N, class T>
Dual<N, T> log(const Dual<N, T>& x) {
  using std::log;
  return detail::chain(x, T(log(x.value)), T(1.0 / x.value));
}
template <std::size_t N, class T>
Dual<N, T> log10(const Dual<N, T>& x) {
  return log(x) * 0.43429448190325182765;
}
template <std::size_t N, class T>
Dual<N, T> atan2(const Dual<N, T>& y, const Dual<N, T>& x) {
  using std::atan2;
  Dual<N, T> r;
  r.value = atan2(y.value, x.value);
  const T inverse = 1.0 / (x.value * x.value + y.value * y.value);
  for (std::size_t k = 0; k < N; ++k) {
    r.partial[k] = (x.value * y.partial[k] - y.value * x.partial[k]) * inverse;
  }
  return r;
}
// x to a constant power; the slope at x = 0 is that of the limit (0 for n > 1, 1 for n = 1).
template <std::size_t N, class T>
Dual<N, T> pow(const Dual<N, T>& x, double n) {
  using std::pow;
  return detail::chain(x, T(pow(x.value, n)), n == 0.0 ? T(0.0) : T(n * pow(x.value, n - 1.0)));
}

}  // namespace dynalin

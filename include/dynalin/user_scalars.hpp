// Numbers that carry derivatives, over which a formula of dynalin/user_routine.hpp is called beside plain ones: with
// their arithmetic, and compared by their values.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

namespace dynalin::user {

// Inputs that are differentiated in one pass.
inline constexpr int pass = 8;

// A number with its partial derivatives with respect to `pass` inputs.
struct Partials {
  double x = 0;
  std::array<double, pass> d{};
  Partials() = default;
  Partials(double number) : x(number) {}  // NOLINT
  friend Partials operator+(Partials a, const Partials& b) {
    a.x += b.x;
    for (std::size_t k = 0; k < pass; ++k) a.d[k] += b.d[k];
    return a;
  }
  friend Partials operator*(const Partials& a, const Partials& b) {
    Partials out(a.x * b.x);
    for (std::size_t k = 0; k < pass; ++k) out.d[k] = a.d[k] * b.x + a.x * b.d[k];
    return out;
  }
  friend double value_of(const Partials& a) { return a.x; }
};
inline double value_of(double a) { return a; }

// A number along the motion: with its first and second time derivative, and the partial derivatives of all three.
struct Course {
  Partials x, x1, x2;
  Course() = default;
  Course(double number) : x(number) {}  // NOLINT
  Course(const Partials& v, const Partials& v1, const Partials& v2) : x(v), x1(v1), x2(v2) {}
  friend Course operator+(const Course& a, const Course& b) { return {a.x + b.x, a.x1 + b.x1, a.x2 + b.x2}; }
  friend Course operator*(const Course& a, const Course& b) {
    return {a.x * b.x, a.x1 * b.x + a.x * b.x1, a.x2 * b.x + Partials(2) * (a.x1 * b.x1) + a.x * b.x2};
  }
  friend double value_of(const Course& a) { return a.x.x; }
};

// f(a), of which `Function::of` gives value, slope and second derivative on any scalar.
template <class Function>
Partials apply(const Partials& a, const Function& function) {
  const std::array<double, 3> f = function.of(a.x);
  Partials out(f[0]);
  for (std::size_t k = 0; k < pass; ++k) out.d[k] = a.d[k] == 0.0 ? 0.0 : f[1] * a.d[k];
  return out;
}
template <class Function>
Course apply(const Course& a, const Function& function) {
  const std::array<Partials, 3> f = function.of(a.x);
  return {f[0], f[1] * a.x1, f[2] * (a.x1 * a.x1) + f[1] * a.x2};
}

template <class T>
concept Scalar = std::same_as<T, Partials> || std::same_as<T, Course>;

namespace slopes {
struct Inverse {
  template <class T>
  std::array<T, 3> of(const T& x) const;
};
}  // namespace slopes

template <Scalar T>
T operator+(const T& a) {
  return a;
}
template <Scalar T>
T operator-(const T& a) {
  return T(-1.0) * a;
}
template <Scalar T>
T operator-(const T& a, const T& b) {
  return a + T(-1.0) * b;
}
template <Scalar T>
T operator+(const T& a, double b) {
  return a + T(b);
}
template <Scalar T>
T operator+(double a, const T& b) {
  return T(a) + b;
}
template <Scalar T>
T operator-(const T& a, double b) {
  return a + T(-b);
}
template <Scalar T>
T operator-(double a, const T& b) {
  return T(a) - b;
}
template <Scalar T>
T operator*(const T& a, double b) {
  return a * T(b);
}
template <Scalar T>
T operator*(double a, const T& b) {
  return T(a) * b;
}
template <Scalar T>
T operator/(const T& a, double b) {
  return a * T(1.0 / b);
}
inline double inverse(double x) { return 1.0 / x; }
template <Scalar T>
T inverse(const T& a) {
  return apply(a, slopes::Inverse{});
}
template <class T>
std::array<T, 3> slopes::Inverse::of(const T& x) const {
  const T i = inverse(x);
  return {i, -(i * i), 2.0 * (i * i * i)};
}
template <Scalar T>
T operator/(const T& a, const T& b) {
  return a * inverse(b);
}
template <Scalar T>
T operator/(double a, const T& b) {
  return T(a) * inverse(b);
}
template <Scalar T, class B>
T& operator+=(T& a, const B& b) {
  return a = a + b;
}
template <Scalar T, class B>
T& operator-=(T& a, const B& b) {
  return a = a - b;
}
template <Scalar T, class B>
T& operator*=(T& a, const B& b) {
  return a = a * b;
}
template <Scalar T, class B>
T& operator/=(T& a, const B& b) {
  return a = a / b;
}

// Comparisons look at values alone.
template <class A, class B>
concept Compared = (Scalar<A> && (Scalar<B> || std::same_as<B, double> || std::same_as<B, int>)) ||
                   (Scalar<B> && (std::same_as<A, double> || std::same_as<A, int>));
template <class A, class B>
requires Compared<A, B>
bool operator<(const A& a, const B& b) { return value_of(a) < value_of(b); }
template <class A, class B>
requires Compared<A, B>
bool operator>(const A& a, const B& b) { return value_of(a) > value_of(b); }
template <class A, class B>
requires Compared<A, B>
bool operator<=(const A& a, const B& b) { return value_of(a) <= value_of(b); }
template <class A, class B>
requires Compared<A, B>
bool operator>=(const A& a, const B& b) { return value_of(a) >= value_of(b); }
template <class A, class B>
requires Compared<A, B>
bool operator==(const A& a, const B& b) { return value_of(a) == value_of(b); }
template <class A, class B>
requires Compared<A, B>
bool operator!=(const A& a, const B& b) { return value_of(a) != value_of(b); }

}  // namespace dynalin::user

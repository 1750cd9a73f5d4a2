// x ** n over any scalar: the operator with a varying exponent, and the stiffness of contacts.
#pragma once

#include <cmath>

#include "expression/functions_define.h"

namespace dynalin {

// The number, with NaN in every derivative in which x has one: a result that does not respond to x
// in a defined way.
inline double undefined_response(double, double number) { return number; }
template <std::size_t N>
Dual<N> undefined_response(const Dual<N>& x, double number) {
  Dual<N> r(number);
  for (std::size_t k = 0; k < N; ++k) {
    if (x.partial[k] != 0.0) r.partial[k] = std::numeric_limits<double>::quiet_NaN();
  }
  return r;
}
template <class T>
TimeTaylor<T> undefined_response(const TimeTaylor<T>& x, double number) {
  const auto derivative = [](const T& d) {
    return undefined_response(d, value_of(d) == 0.0 ? 0.0 : std::numeric_limits<double>::quiet_NaN());
  };
  return {undefined_response(x.value, number), derivative(x.rate), derivative(x.acceleration)};
}

// x ** n = x ** m · EXP((n − m) LOG(x)) with the number m = n, which keeps the value exact.
// Derivatives n x ** (n − 1) and x ** n LOG(x). For x < 0 and whole n there is a value and a
// derivative with respect to x alone; at x = 0 the derivative with respect to n > 0 is 0.
template <class T>
T power(const T& x, const T& n) {
  using std::exp, std::log, std::pow;
  const double m = value_of(n);
  const T base = pow(x, m);
  if (is_plain(n)) return base;
  if (value_of(x) > 0.0) return base * exp(T((n - m) * log(x)));
  if (value_of(x) == 0.0 && m > 0.0) return base;
  return base + undefined_response(T(n - m), 0.0);
}

}  // namespace dynalin

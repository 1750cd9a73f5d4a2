// The mathematical functions of the expression language over numbers or jets, from their definitions.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "expression.h"
#include "jet.h"

namespace dynalin::oracle {

// Cubic and quintic blends from h0 at x0 to h1 at x1, and the half wave of the sine between them.
template <class T>
[[nodiscard]] T step_of(const T& x, const T& x0, const T& h0, const T& x1, const T& h1) {
  if (value_of(x) <= value_of(x0)) return h0;
  if (value_of(x) >= value_of(x1)) return h1;
  const T s = (x - x0) / (x1 - x0);
  return h0 + (h1 - h0) * s * s * (T(3) - T(2) * s);
}
template <class T>
[[nodiscard]] T step5_of(const T& x, const T& x0, const T& h0, const T& x1, const T& h1) {
  if (value_of(x) <= value_of(x0)) return h0;
  if (value_of(x) >= value_of(x1)) return h1;
  // Horner from the other end than the usual 10 - 15 s + 6 s^2.
  const T s = (x - x0) / (x1 - x0), r = T(1) - s;
  return h0 + (h1 - h0) * s * s * s * (T(1) + T(3) * r + T(6) * r * r);
}
template <class T>
[[nodiscard]] T havsin_of(const T& x, const T& x0, const T& h0, const T& x1, const T& h1) {
  using std::sin;
  if (value_of(x) <= value_of(x0)) return h0;
  if (value_of(x) >= value_of(x1)) return h1;
  // (1 + sin(pi s - pi/2)) / 2 = sin^2(pi s / 2)
  const T wave = sin((x - x0) / (x1 - x0) * T(std::numbers::pi_v<Real> / 2));
  return h0 + (h1 - h0) * wave * wave;
}

template <class T>
[[nodiscard]] T raise_of(const T& base, const T& exponent) {
  using std::exp;
  using std::log;
  return exp(exponent * log(base));
}

// Penetration p > 0 at rate p' > 0 inwards: k p^e plus damping that grows to c at depth d; never attractive.
template <class T>
[[nodiscard]] T contact_of(const T& p, const T& rate, const T& k, const T& e, const T& c, const T& d) {
  if (value_of(p) <= 0) return T(0);
  const T force = k * raise_of(p, e) + step_of(p, T(0), T(0), d, c) * rate;
  return value_of(force) > 0 ? force : T(0);
}

// Sum of a[first + j] f(j) with f(j) from a function of the index.
template <class T, class F>
[[nodiscard]] T series(const std::vector<T>& a, std::size_t first, F&& f) {
  T sum(0);
  for (std::size_t k = first; k < a.size(); ++k) sum = sum + a[k] * f(k - first);
  return sum;
}

// The phase of SWEEP over 2 pi: the integral of a frequency f0 before x0, f1 after x1, linear between, 0 at x = 0.
template <class T>
[[nodiscard]] T swept_turns(const T& x, const T& x0, const T& f0, const T& x1, const T& f1) {
  if (value_of(x) <= value_of(x0)) return f0 * x;
  if (value_of(x) >= value_of(x1)) return f0 * x0 + (f0 + f1) / T(2) * (x1 - x0) + f1 * (x - x1);
  const T rate = (f1 - f0) / (x1 - x0);
  return f0 * x0 + (f0 + rate * (x - x0) / T(2)) * (x - x0);
}

template <class T>
[[nodiscard]] T mathematical_function(Function f, const std::vector<T>& a) {
  using std::atan;
  using std::atan2;
  using std::cos;
  using std::exp;
  using std::log;
  using std::sin;
  using std::sqrt;
  const T& x = a[0];
  const Real v = value_of(x);
  switch (f) {
    case Function::sin:
      return sin(x);
    case Function::cos:
      return cos(x);
    case Function::tan:
      return sin(x) / cos(x);
    case Function::asin:
      return atan2(x, sqrt(T(1) - x * x));
    case Function::acos:
      return atan2(sqrt(T(1) - x * x), x);
    case Function::atan:
      return atan(x);
    case Function::atan2:
      return atan2(x, a[1]);
    case Function::sinh:
      return (exp(x) - exp(-x)) / T(2);
    case Function::cosh:
      return (exp(x) + exp(-x)) / T(2);
    case Function::tanh:
      return T(1) - T(2) / (exp(T(2) * x) + T(1));
    case Function::exp:
      return exp(x);
    case Function::log:
      return log(x);
    case Function::log10:
      return log(x) / T(std::log(10.0L));
    case Function::sqrt:
      return sqrt(x);
    case Function::raise:
      return raise_of(x, a[1]);
    case Function::abs:
      return v < 0 ? -x : x;
    case Function::aint:
      return T(std::trunc(v));
    case Function::anint:
      return T(std::round(v));
    case Function::dim:
      return v > value_of(a[1]) ? x - a[1] : T(0);
    case Function::maximum: {
      T best = x;
      for (const T& other : a) best = value_of(other) > value_of(best) ? other : best;
      return best;
    }
    case Function::minimum: {
      T best = x;
      for (const T& other : a) best = value_of(other) < value_of(best) ? other : best;
      return best;
    }
    case Function::mod:
      return x - T(std::trunc(v / value_of(a[1]))) * a[1];
    case Function::sign: {
      const bool opposite = (v < 0) != (value_of(a[1]) < 0);
      return opposite ? -x : x;
    }
    case Function::choose:
      return v < 0 ? a[1] : v > 0 ? a[3] : a[2];
    case Function::step:
      return step_of(x, a[1], a[2], a[3], a[4]);
    case Function::step5:
      return step5_of(x, a[1], a[2], a[3], a[4]);
    case Function::havsin:
      return havsin_of(x, a[1], a[2], a[3], a[4]);
    case Function::impact:
      return contact_of(a[2] - x, -a[1], a[3], a[4], a[5], a[6]);
    case Function::bistop:
      if (value_of(a[2]) > v) return contact_of(a[2] - x, -a[1], a[4], a[5], a[6], a[7]);
      return -contact_of(x - a[3], a[1], a[4], a[5], a[6], a[7]);
    case Function::poly:
      return series(a, 2, [&](std::size_t j) {
        T power(1);
        for (std::size_t k = 0; k < j; ++k) power = power * (x - a[1]);
        return power;
      });
    case Function::cheby:
      return series(a, 2, [&](std::size_t j) {
        T before(1), now = x - a[1];
        for (std::size_t k = 0; k < j; ++k) {
          const T next = T(2) * (x - a[1]) * now - before;
          before = now;
          now = next;
        }
        return before;
      });
    case Function::forsin:
      return series(a, 3, [&](std::size_t j) { return j == 0 ? T(1) : sin(T(Real(j)) * a[2] * (x - a[1])); });
    case Function::forcos:
      return series(a, 3, [&](std::size_t j) { return cos(T(Real(j)) * a[2] * (x - a[1])); });
    case Function::shf:
      return a[2] * sin(a[3] * (x - a[1]) - a[4]) + a[5];
    case Function::sweep: {
      const T ramp = step5_of(x, a[2], T(0), a[2] + a[6], T(1));
      return ramp * a[1] * sin(T(2 * std::numbers::pi_v<Real>) * swept_turns(x, a[2], a[3], a[4], a[5]));
    }
  }
  throw std::runtime_error("an expression has an unknown function");
}

}  // namespace dynalin::oracle

// The functions that a formula of dynalin/user_routine.hpp takes, of plain numbers and of those that carry derivatives.
#pragma once

// Of these abs of a double is in no namespace; without them abs(v) would be that of an integer.
#include <math.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "dynalin/user_routine.h"
#include "dynalin/user_scalars.hpp"

namespace dynalin::user {

// Of plain numbers, so that they are found beside those of other scalars.
using std::abs, std::fabs, std::sqrt, std::cbrt, std::pow, std::hypot, std::sin, std::cos, std::tan, std::asin,
    std::acos, std::atan, std::atan2, std::sinh, std::cosh, std::tanh, std::asinh, std::acosh, std::atanh, std::exp,
    std::exp2, std::expm1, std::log, std::log2, std::log10, std::log1p, std::erf, std::floor, std::ceil, std::trunc,
    std::fmod, std::copysign;

template <Scalar T>
T sin(const T& a);
template <Scalar T>
T cos(const T& a);
template <Scalar T>
T exp(const T& a);
template <Scalar T>
T log(const T& a);
template <Scalar T>
T sqrt(const T& a);
template <Scalar T>
T tanh(const T& a);
template <Scalar T>
T atan(const T& a);
template <Scalar T>
T pow(const T& a, double n);
template <Scalar T>
T expm1(const T& a);
template <Scalar T>
T log1p(const T& a);
template <Scalar T>
T asinh(const T& a);
template <Scalar T>
T cbrt(const T& a);
template <Scalar T>
T erf(const T& a);

namespace slopes {
struct Sin {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T s = sin(x), c = cos(x);
    return {s, c, -s};
  }
};
struct Cos {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T s = sin(x), c = cos(x);
    return {c, -s, -c};
  }
};
struct Exp {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T e = exp(x);
    return {e, e, e};
  }
};
struct Log {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T i = inverse(x);
    return {log(x), i, -(i * i)};
  }
};
struct Sqrt {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T r = sqrt(x), slope = 0.5 * inverse(r);
    return {r, slope, -0.5 * (slope * inverse(x))};
  }
};
struct Tanh {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T t = tanh(x), slope = 1.0 - t * t;
    return {t, slope, -2.0 * (t * slope)};
  }
};
struct Atan {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T slope = inverse(1.0 + x * x);
    return {atan(x), slope, -2.0 * (x * (slope * slope))};
  }
};
struct Pow {
  double n;
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const auto term = [&](double factor, double exponent) {
      return factor == 0.0 ? T(0.0) : factor * pow(x, exponent);
    };
    return {pow(x, n), term(n, n - 1), term(n * (n - 1), n - 2)};
  }
};
struct Expm1 {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T e = exp(x);
    return {expm1(x), e, e};
  }
};
struct Log1p {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T i = inverse(1.0 + x);
    return {log1p(x), i, -(i * i)};
  }
};
struct Asinh {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T slope = inverse(sqrt(1.0 + x * x));
    return {asinh(x), slope, -(x * (slope * slope * slope))};
  }
};
struct Cbrt {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T r = cbrt(x), i = inverse(x), slope = r * i * (1.0 / 3.0);
    return {r, slope, slope * i * (-2.0 / 3.0)};
  }
};
struct Erf {
  template <class T>
  std::array<T, 3> of(const T& x) const {
    const T slope = 1.1283791670955126 * exp(-(x * x));  // 2/√π
    return {erf(x), slope, -2.0 * (x * slope)};
  }
};
}  // namespace slopes

template <Scalar T>
T sin(const T& a) {
  return apply(a, slopes::Sin{});
}
template <Scalar T>
T cos(const T& a) {
  return apply(a, slopes::Cos{});
}
template <Scalar T>
T tan(const T& a) {
  return sin(a) / cos(a);
}
template <Scalar T>
T exp(const T& a) {
  return apply(a, slopes::Exp{});
}
template <Scalar T>
T log(const T& a) {
  return apply(a, slopes::Log{});
}
template <Scalar T>
T sqrt(const T& a) {
  return apply(a, slopes::Sqrt{});
}
template <Scalar T>
T tanh(const T& a) {
  return apply(a, slopes::Tanh{});
}
template <Scalar T>
T atan(const T& a) {
  return apply(a, slopes::Atan{});
}
template <Scalar T>
T pow(const T& a, double n) {
  return apply(a, slopes::Pow{n});
}
template <Scalar T>
T pow(const T& a, const T& b) {
  return exp(b * log(a));
}
template <Scalar T>
T sinh(const T& a) {
  return 0.5 * (exp(a) - exp(-a));
}
template <Scalar T>
T cosh(const T& a) {
  return 0.5 * (exp(a) + exp(-a));
}
template <Scalar T>
T abs(const T& a) {
  return value_of(a) < 0.0 ? -a : a;
}
template <Scalar T>
T fabs(const T& a) {
  return abs(a);
}
template <Scalar T>
T atan2(const T& y, const T& x) {
  // The branch from the values, the slope from the quotient that is defined here.
  const double angle = std::atan2(value_of(y), value_of(x));
  const T plain = std::abs(value_of(x)) > std::abs(value_of(y)) ? atan(y / x) : -atan(x / y);
  return plain + (angle - value_of(plain));
}
template <Scalar T>
T atan2(const T& y, double x) {
  return atan2(y, T(x));
}
template <Scalar T>
T atan2(double y, const T& x) {
  return atan2(T(y), x);
}
template <Scalar T>
T pow(double a, const T& b) {
  return exp(b * std::log(a));
}
template <Scalar T>
T expm1(const T& a) {
  return apply(a, slopes::Expm1{});
}
template <Scalar T>
T log1p(const T& a) {
  return apply(a, slopes::Log1p{});
}
template <Scalar T>
T asinh(const T& a) {
  return apply(a, slopes::Asinh{});
}
template <Scalar T>
T cbrt(const T& a) {
  return apply(a, slopes::Cbrt{});
}
template <Scalar T>
T erf(const T& a) {
  return apply(a, slopes::Erf{});
}
template <Scalar T>
T asin(const T& a) {
  return atan2(a, sqrt((1.0 - a) * (1.0 + a)));
}
template <Scalar T>
T acos(const T& a) {
  return atan2(sqrt((1.0 - a) * (1.0 + a)), a);
}
template <Scalar T>
T acosh(const T& a) {
  return log(a + sqrt((a - 1.0) * (a + 1.0)));
}
template <Scalar T>
T atanh(const T& a) {
  return 0.5 * (log1p(a) - log1p(-a));
}
template <Scalar T>
T exp2(const T& a) {
  return exp(a * 0.6931471805599453);  // ln 2
}
template <Scalar T>
T log2(const T& a) {
  return log(a) / 0.6931471805599453;
}
template <Scalar T>
T log10(const T& a) {
  return log(a) / 2.302585092994046;
}
template <Scalar T>
T hypot(const T& a, const T& b) {
  return sqrt(a * a + b * b);
}
template <Scalar T>
T hypot(const T& a, double b) {
  return hypot(a, T(b));
}
template <Scalar T>
T hypot(double a, const T& b) {
  return hypot(T(a), b);
}
// Steps: their slope is zero.
template <Scalar T>
T floor(const T& a) {
  return std::floor(value_of(a));
}
template <Scalar T>
T ceil(const T& a) {
  return std::ceil(value_of(a));
}
template <Scalar T>
T trunc(const T& a) {
  return std::trunc(value_of(a));
}
// a less a whole number of times b.
template <Scalar T, class B>
T fmod(const T& a, const B& b) {
  const double rest = std::fmod(value_of(a), value_of(b));
  const T along = a - std::round((value_of(a) - rest) / value_of(b)) * b;
  return along + (rest - value_of(along));
}
template <Scalar T>
T fmod(double a, const T& b) {
  const double rest = std::fmod(a, value_of(b));
  const T along = a - std::round((a - rest) / value_of(b)) * b;
  return along + (rest - value_of(along));
}
template <Scalar T, class B>
T copysign(const T& a, const B& b) {
  return std::signbit(value_of(b)) == std::signbit(value_of(a)) ? a : -a;
}
template <Scalar T>
T copysign(double a, const T& b) {
  return std::copysign(a, value_of(b));
}
inline double min(double a, double b) { return std::min(a, b); }
inline double max(double a, double b) { return std::max(a, b); }
template <Scalar T>
T min(const T& a, double b) {
  return b < value_of(a) ? T(b) : a;
}
template <Scalar T>
T min(double a, const T& b) {
  return value_of(b) < a ? b : T(a);
}
template <Scalar T>
T max(const T& a, double b) {
  return value_of(a) < b ? T(b) : a;
}
template <Scalar T>
T max(double a, const T& b) {
  return a < value_of(b) ? b : T(a);
}
template <Scalar T>
T min(const T& a, const T& b) {
  return value_of(b) < value_of(a) ? b : a;
}
template <Scalar T>
T max(const T& a, const T& b) {
  return value_of(a) < value_of(b) ? b : a;
}

// Functions of the language, with the arguments that they have there.
template <class T, class B>
T sign(const T& a, const B& b) {
  return value_of(b) < 0.0 ? -fabs(a) : fabs(a);
}
template <class T>
T step(const T& x, double x0, double h0, double x1, double h1) {
  const T share = (x - x0) / (x1 - x0);
  if (value_of(share) <= 0.0) return T(h0);
  if (value_of(share) >= 1.0) return T(h1);
  return h0 + (h1 - h0) * (share * share * (3.0 - 2.0 * share));
}
template <class T>
T step5(const T& x, double x0, double h0, double x1, double h1) {
  const T share = (x - x0) / (x1 - x0);
  if (value_of(share) <= 0.0) return T(h0);
  if (value_of(share) >= 1.0) return T(h1);
  return h0 + (h1 - h0) * (share * share * share * (10.0 - share * (15.0 - 6.0 * share)));
}
template <class T>
T havsin(const T& x, double x0, double h0, double x1, double h1) {
  const T share = (x - x0) / (x1 - x0);
  if (value_of(share) <= 0.0) return T(h0);
  if (value_of(share) >= 1.0) return T(h1);
  return 0.5 * (h0 + h1) - (0.5 * (h1 - h0)) * cos(3.141592653589793 * share);
}
template <class T>
T impact(const T& x, const T& rate, double x1, double k, double e, double cmax, double d) {
  if (value_of(x) >= x1) return T(0.0);
  const T force = k * pow(x1 - x, e) - cmax * (rate * step(x, x1 - d, 1.0, x1, 0.0));
  return value_of(force) > 0.0 ? force : T(0.0);
}
template <class T>
T bistop(const T& x, const T& rate, double x1, double x2, double k, double e, double cmax, double d) {
  if (value_of(x) <= x2) return impact(x, rate, x1, k, e, cmax, d);
  return -impact(T(-x), T(-rate), -x2, k, e, cmax, d);
}

template <class T>
T value_of_spline(int method, const T& x, const T& z, int id) {
  std::array<double, 8> c{};
  dynalin_spline(method, id, value_of(x), value_of(z), c.data());
  const T s = x - value_of(x), h = z - value_of(z);
  const auto cubic = [&](int first) {
    const double* a = c.data() + first;
    return a[0] + s * (a[1] + s * (a[2] + s * a[3]));
  };
  return cubic(0) + h * cubic(4);
}
// The SPLINE id at x, on the curve z of a family, as the functions AKISPL and CUBSPL of the language read it.
template <class T>
T akispl(const T& x, const T& z, int id) {
  return value_of_spline('A', x, z, id);
}
template <class T>
T cubspl(const T& x, const T& z, int id) {
  return value_of_spline('C', x, z, id);
}
template <Scalar T>
T akispl(const T& x, double z, int id) {
  return akispl(x, T(z), id);
}
template <Scalar T>
T cubspl(const T& x, double z, int id) {
  return cubspl(x, T(z), id);
}

}  // namespace dynalin::user

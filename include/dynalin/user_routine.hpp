// Compiled user routines written once, with all derivatives that the program needs: a formula over any scalar.
//
//     #include <dynalin/user_routine.hpp>
//
//     struct Friction {
//       template <class T>
//       void operator()(const dynalin::user::Call<T>& call, T* value) const {
//         const T v = call.measure("VX", {10, 20, 20});
//         value[0] = -call.parameter(0) * tanh(v / call.parameter(1));
//       }
//     };
//     DYNALIN_USER_ROUTINE(sfosub, Friction)
//
// The formula is called with T = double for values, and with scalars that carry derivatives beside them. It takes
// functions without a namespace in front of them (sin, not std::sin), and compares scalars by their values: abs fabs
// sqrt cbrt pow hypot, sin cos tan asin acos atan atan2, sinh cosh tanh asinh acosh atanh, exp exp2 expm1 log log2
// log10 log1p, erf, floor ceil trunc fmod copysign. With `using namespace dynalin::user;` in it also value_of min max,
// and of the language sign step step5 havsin impact bistop, whose arguments behind the first (of impact and bistop the
// second) are plain numbers.
#pragma once

// Of these abs of a double is in no namespace; without them abs(v) would be that of an integer.
#include <math.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <initializer_list>
#include <vector>

#include "dynalin/user_routine.h"

namespace dynalin::user {

// Of plain numbers, so that they are found beside those of other scalars.
using std::abs, std::fabs, std::sqrt, std::cbrt, std::pow, std::hypot, std::sin, std::cos, std::tan, std::asin,
    std::acos, std::atan, std::atan2, std::sinh, std::cosh, std::tanh, std::asinh, std::acosh, std::atanh, std::exp,
    std::exp2, std::expm1, std::log, std::log2, std::log10, std::log1p, std::erf, std::floor, std::ceil, std::trunc,
    std::fmod, std::copysign;

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
    for (int k = 0; k < pass; ++k) a.d[k] += b.d[k];
    return a;
  }
  friend Partials operator*(const Partials& a, const Partials& b) {
    Partials out(a.x * b.x);
    for (int k = 0; k < pass; ++k) out.d[k] = a.d[k] * b.x + a.x * b.d[k];
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
  for (int k = 0; k < pass; ++k) out.d[k] = a.d[k] == 0.0 ? 0.0 : f[1] * a.d[k];
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
template <Scalar T>
T fmod(const T& a, double b) {
  return a - (value_of(a) - std::fmod(value_of(a), b));
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

// What formulas of a GSE read: its states, inputs and discrete states by their places, counted from 0, and x′ of an
// implicit one.
template <class Self, class T>
struct CallOfStateEquations {
  T state(int k) const { return self().measure("ARRAY", {dynalin_gse_array('X')}, k); }
  T rate(int k) const { return self().measure("GSE_XDOT", {self().id()}, k); }
  T input(int k) const { return self().measure("ARRAY", {dynalin_gse_array('U')}, k); }
  T discrete(int k) const { return self().measure("ARRAY", {dynalin_gse_array('D')}, k); }

 private:
  const Self& self() const { return static_cast<const Self&>(*this); }
};

// What formulas of a CONTACT get: number k of places, normals and slip, counted from 0. Those of its friction have no
// normals, and other places.
template <class Self, class T>
struct CallOfContact {
  T location_I(int k) const { return self().given(k); }
  T normal_I(int k) const { return self().given(3 + k); }
  T location_J(int k) const { return self().given(6 + k); }
  T normal_J(int k) const { return self().given(9 + k); }
  T gap() const { return self().given(12); }
  T gap_rate() const { return self().given(13); }
  T location_J_of_friction(int k) const { return self().given(3 + k); }
  T slip(int k) const { return self().given(6 + k); }
  T normal_force() const { return self().given(9); }

 private:
  const Self& self() const { return static_cast<const Self&>(*this); }
};

// What a formula reads. All it asks for must be the same each time, whatever the values are.
template <class T>
class Call : public CallOfStateEquations<Call<T>, T>, public CallOfContact<Call<T>, T> {
 public:
  Call(const dynalin_course& course, int first) : course_(&course), first_(first) {}
  int id() const { return course_->id; }
  // Not a number where there is none.
  double parameter(int k) const { return k >= 0 && k < course_->npar ? course_->par[k] : std::nan(""); }
  int parameters() const { return course_->npar; }
  T time() const { return number(0); }
  // Of a FIELD: number k of disp and of velo, counted from 0.
  T displacement(int k) const { return number(2 + k); }
  T velocity(int k) const { return number(8 + k); }
  // What comes as an argument: of a COUPLER displacement k of its joints, of a CONTACT see above.
  T given(int k) const { return number(2 + k); }
  // As c_sysfnc gives it.
  T measure(const char* name, std::initializer_list<int> ids) const {
    return number(dynalin_input(name, ids.begin(), static_cast<int>(ids.size())));
  }
  // Number n of what c_sysary gives.
  T measure(const char* name, std::initializer_list<int> ids, int n) const {
    return number(dynalin_input_of_array(name, ids.begin(), static_cast<int>(ids.size()), n));
  }

 private:
  T number(int k) const {
    if (k < 0) return T(std::nan(""));
    const int stride = course_->order + 1;
    T x(course_->input[stride * k]);
    const int seed = k - first_;
    const bool seeded = seed >= 0 && seed < pass;
    if constexpr (std::same_as<T, Course>) {
      x.x1 = course_->input[stride * k + 1], x.x2 = course_->input[stride * k + 2];
      if (seeded) x.x.d[static_cast<std::size_t>(seed)] = 1.0;
    } else if (seeded) {
      x.d[static_cast<std::size_t>(seed)] = 1.0;
    }
    return x;
  }
  const dynalin_course* course_;
  int first_;
};

template <>
class Call<double> : public CallOfStateEquations<Call<double>, double>, public CallOfContact<Call<double>, double> {
 public:
  Call(int id, double time, const double* par, int npar, const double* disp = nullptr, const double* velo = nullptr)
      : id_(id), time_(time), par_(par), npar_(npar), disp_(disp), velo_(velo) {}
  Call(int id, double time, const double* par, int npar, std::initializer_list<double> given)
      : id_(id), time_(time), par_(par), npar_(npar), disp_(nullptr), velo_(nullptr) {
    std::copy(given.begin(), given.end(), given_.begin());
  }
  double given(int k) const { return given_[static_cast<std::size_t>(k)]; }
  int id() const { return id_; }
  double parameter(int k) const { return k >= 0 && k < npar_ ? par_[k] : std::nan(""); }
  int parameters() const { return npar_; }
  double time() const { return time_; }
  double displacement(int k) const { return disp_[k]; }
  double velocity(int k) const { return velo_[k]; }
  double measure(const char* name, std::initializer_list<int> ids) const {
    double state = 0;
    int error = 0;
    c_sysfnc(name, ids.begin(), static_cast<int>(ids.size()), &state, &error);
    return state;
  }
  double measure(const char* name, std::initializer_list<int> ids, int n) const {
    int error = 0, count = 0;
    c_sysary(name, ids.begin(), static_cast<int>(ids.size()), nullptr, &count, &error);
    std::vector<double> states(static_cast<std::size_t>(std::max(count, 1)));
    c_sysary(name, ids.begin(), static_cast<int>(ids.size()), states.data(), &count, &error);
    return n < count ? states[static_cast<std::size_t>(n)] : std::nan("");
  }

 private:
  int id_;
  double time_;
  const double* par_;
  int npar_;
  const double *disp_, *velo_;
  std::array<double, 14> given_{};
};

// Fills in the values and derivatives of a course, a pass of inputs at a time.
template <class Formula>
void fill_course(const dynalin_course& c) {
  const int stride = c.order + 1;
  for (int first = 0; first < c.inputs; first += pass) {
    const auto take = [&]<class T>(T) {
      std::vector<T> value(static_cast<std::size_t>(c.values));
      Formula{}(Call<T>(c, first), value.data());
      for (int v = 0; v < c.values; ++v) {
        const auto put = [&](const Partials& p, int d) {
          c.value[stride * v + d] = p.x;
          for (int k = first; k < std::min(first + pass, c.inputs); ++k)
            c.partial[stride * (c.inputs * v + k) + d] = p.d[static_cast<std::size_t>(k - first)];
        };
        const T& of = value[static_cast<std::size_t>(v)];
        if constexpr (std::same_as<T, Course>) {
          put(of.x, 0), put(of.x1, 1), put(of.x2, 2);
        } else {
          put(of, 0);
        }
      }
    };
    if (c.order == 0) {
      take(Partials());
    } else {
      take(Course());
    }
  }
}

}  // namespace dynalin::user

// The routine `name` of a VARIABLE, SFORCE, GFORCE, VFORCE, VTORQUE, DIFF or MOTION, and its entry with derivatives.
#define DYNALIN_USER_ROUTINE(name, Formula)                                                                           \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const int*, const int*, \
                       double* value) {                                                                               \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar), value);                                            \
  }                                                                                                                   \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine reqsub of a REQUEST, with eight values, of which those that are not written are 0; of sensub or
// sevsub of a SENSOR, with one. Nobody asks for their derivatives.
#define DYNALIN_USER_REQUEST(name, Formula)                                                               \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const int*, \
                       double* value) {                                                                   \
    std::fill_n(value, 8, 0.0);                                                                           \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar), value);                                \
  }
#define DYNALIN_USER_SENSOR(name, Formula)                                                                \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const int*, \
                       double* value) {                                                                   \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar), value);                                \
  }

// The same of a routine gse_deriv, gse_output or gse_update of a GSE.
#define DYNALIN_USER_STATE_EQUATIONS(name, Formula)                                                                   \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const int*, const int*, \
                       const int*, double* value) {                                                                   \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar), value);                                            \
  }                                                                                                                   \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine fiesub of a FIELD: a formula of call.displacement and call.velocity, with six values.
#define DYNALIN_USER_FIELD(name, Formula)                                                                         \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const double* disp, \
                       const double* velo, const int*, const int*, double* field, double*, double*) {             \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar, disp, velo), field);                            \
  }                                                                                                               \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine cnfsub of a CONTACT: a formula of call.gap and call.gap_rate, of places and normals, with three
// values.
#define DYNALIN_USER_CONTACT(name, Formula)                                                                           \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const double* loci,     \
                       const double* ni, const double* locj, const double* nj, const double* gap,                     \
                       const double* gapdot, const double*, const double*, const int*, const int*, double* value) {   \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar,                                                     \
                                          {loci[0], loci[1], loci[2], ni[0], ni[1], ni[2], locj[0], locj[1], locj[2], \
                                           nj[0], nj[1], nj[2], *gap, *gapdot}),                                      \
              value);                                                                                                 \
  }                                                                                                                   \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine cffsub of a CONTACT: a formula of call.slip and call.normal_force, with three values.
#define DYNALIN_USER_CONTACT_FRICTION(name, Formula)                                                               \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const double* loci,  \
                       const double* locj, const double*, const double* xdot, const double* nforce, const double*, \
                       const int*, const int*, double* value) {                                                    \
    Formula{}(dynalin::user::Call<double>(                                                                         \
                  *id, *time, par, *npar,                                                                          \
                  {loci[0], loci[1], loci[2], locj[0], locj[1], locj[2], xdot[0], xdot[1], xdot[2], *nforce}),     \
              value);                                                                                              \
  }                                                                                                                \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The same of a routine cousub of a COUPLER: a formula of call.given(k), displacement k of its joints, with one value.
#define DYNALIN_USER_COUPLER(name, Formula)                                                                        \
  extern "C" void name(const int* id, const double* time, const double* par, const int* npar, const double* disp,  \
                       const int* ndisp, const int*, double* value) {                                              \
    Formula{}(dynalin::user::Call<double>(*id, *time, par, *npar, {disp[0], disp[1], *ndisp > 2 ? disp[2] : 0.0}), \
              value);                                                                                              \
  }                                                                                                                \
  extern "C" void name##_derivatives(const dynalin_course* course) { dynalin::user::fill_course<Formula>(*course); }

// The functions of FORTRAN 77, in double precision: ABS … SIGN, and the operator **.
//
// Each comment states the value and, at a kink, the derivative that is used there.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "expression/functions_define.h"
#include "expression/functions_power.h"

namespace dynalin {

namespace {

// --- smooth functions
// ------------------------------------------------------------------------------ ACOS(1) and
// ASIN(1) have a value and an infinite derivative, so has SQRT(0).
constexpr auto arc_cosine = []<class T>(const T& x) {
  using std::acos;
  return acos(x);
};
constexpr auto arc_sine = []<class T>(const T& x) {
  using std::asin;
  return asin(x);
};
constexpr auto arc_tangent = []<class T>(const T& x) {
  using std::atan;
  return atan(x);
};
constexpr auto cosine_of = []<class T>(const T& x) {
  using std::cos;
  return cos(x);
};
constexpr auto sine_of = []<class T>(const T& x) {
  using std::sin;
  return sin(x);
};
constexpr auto tangent = []<class T>(const T& x) {
  using std::tan;
  return tan(x);
};
constexpr auto hyperbolic_cosine = []<class T>(const T& x) {
  using std::cosh;
  return cosh(x);
};
constexpr auto hyperbolic_sine = []<class T>(const T& x) {
  using std::sinh;
  return sinh(x);
};
constexpr auto hyperbolic_tangent = []<class T>(const T& x) {
  using std::tanh;
  return tanh(x);
};
constexpr auto exponential = []<class T>(const T& x) {
  using std::exp;
  return exp(x);
};
constexpr auto square_root = []<class T>(const T& x) {
  using std::sqrt;
  return sqrt(x);
};
constexpr auto natural_logarithm = []<class T>(const T& x) {
  using std::log;
  return log(x);
};
constexpr auto decimal_logarithm = []<class T>(const T& x) {
  using std::log10;
  return log10(x);
};

// ATAN2(y, x): the angle of the point (x, y) in (−π, π]. Adding 0 turns −0 into 0, so that the
// negative x axis is at π and never at −π. At the origin the value is 0 and the derivative is not
// defined.
constexpr auto angle_of_point = []<class T>(const T& y, const T& x) {
  using std::atan2;
  return atan2(T(y + 0.0), T(x + 0.0));
};
// Around the origin a sign cannot change once alone: it does so as well where the angle is 0, of no consequence.
void angle_switches(std::span<const double> a, SwitchList& out) { out.add(a[0], a[1] < 0.0); }

// --- functions with kinks and jumps
// ------------------------------------------------------------------ ABS(a): at 0 the derivative is
// 0.
constexpr auto absolute = []<class T>(const T& a) {
  if (value_of(a) < 0.0) return -a;
  return value_of(a) == 0.0 ? T(0.0) : a;
};

void sign_of_first(std::span<const double> a, SwitchList& out) { out.add(a[0]); }

// Changes its sign at all whole numbers but 0.
double whole_number_switch(double a) {
  if (a == 0.0) return 1.0;
  return std::sin(std::numbers::pi * std::remainder(a, 2.0)) / (std::numbers::pi * a);
}

// AINT(a): a without its fraction, toward 0; derivative 0 everywhere.
constexpr auto truncated = []<class T>(const T& a) { return T(std::trunc(value_of(a))); };
void truncation_switches(std::span<const double> a, SwitchList& out) { out.add(whole_number_switch(a[0])); }

// ANINT(a): the nearest whole number, halves away from 0; derivative 0 everywhere.
constexpr auto rounded = []<class T>(const T& a) { return T(std::round(value_of(a))); };
void rounding_switches(std::span<const double> a, SwitchList& out) {
  out.add(std::cos(std::numbers::pi * std::remainder(a[0], 2.0)));
}

// DIM(a, b): a − b where that is positive, else 0; at a = b the derivative is 0.
constexpr auto positive_difference = []<class T>(const T& a, const T& b) {
  return value_of(a) <= value_of(b) ? T(0.0) : T(a - b);
};
void difference_switches(std::span<const double> a, SwitchList& out) { out.add(a[0] - a[1]); }

// MAX(a, b, …), MIN(a, b, …): derivative of the one selected, of the first on a tie. NaN wins, to
// be noticed.
constexpr auto largest_of = []<class T>(std::span<const T> a) {
  std::size_t selected = 0;
  for (std::size_t k = 1; k < a.size() && !std::isnan(value_of(a[selected])); ++k) {
    if (!(value_of(a[k]) <= value_of(a[selected]))) selected = k;
  }
  return a[selected];
};
constexpr auto smallest = []<class T>(std::span<const T> a) {
  std::size_t selected = 0;
  for (std::size_t k = 1; k < a.size() && !std::isnan(value_of(a[selected])); ++k) {
    if (!(value_of(a[k]) >= value_of(a[selected]))) selected = k;
  }
  return a[selected];
};
// Each but the last one against the best of the others: it becomes the one selected, or stops to be it.
template <class Better>
void selection_switches(std::span<const double> a, SwitchList& out, Better better) {
  for (std::size_t k = 0; k + 1 < a.size(); ++k) {
    double rival = a[k + 1];
    for (std::size_t j = 0; j < a.size(); ++j) {
      if (j != k && better(a[j], rival)) rival = a[j];
    }
    out.add(a[k] - rival);
  }
}
void largest_switches(std::span<const double> a, SwitchList& out) { selection_switches(a, out, std::greater<>()); }
void smallest_switches(std::span<const double> a, SwitchList& out) { selection_switches(a, out, std::less<>()); }

// MOD(a, b) = a − AINT(a/b) b, with the sign of a; derivative 1 and −AINT(a/b), also at the jumps.
// The value is that of fmod, because a/b may round up to a whole number that it does not reach.
constexpr auto remainder_of_division = []<class T>(const T& a, const T& b) {
  const double exact = std::fmod(value_of(a), value_of(b));
  const double quotient = std::round((value_of(a) - exact) / value_of(b));
  const T r = a - quotient * b;
  return T(r + (exact - value_of(r)));
};
void remainder_switches(std::span<const double> a, SwitchList& out) { out.add(whole_number_switch(a[0] / a[1])); }

// SIGN(a, b): |a| with the sign of b, plus for b = 0; derivative 0 at a = 0 and with respect to b.
constexpr auto with_sign_of = []<class T>(const T& a, const T& b) {
  if (std::isnan(value_of(b))) return undefined<T>();
  return value_of(b) < 0.0 ? T(-absolute(a)) : T(absolute(a));
};
void sign_switches(std::span<const double> a, SwitchList& out) {
  out.add(a[0]);
  out.add(a[1]);
}

constexpr auto power_of = []<class T>(const T& x, const T& n) { return power(x, n); };

// --- where there is no value
// -------------------------------------------------------------------------
// With the digits that tell it from ±1.
std::string cosine_range(std::string_view name, double a) {
  if (!(std::fabs(a) > 1.0)) return "";
  const bool just_outside = std::fabs(a) < 1.00001;
  return fmt::format("{} of {}, which is outside −1 … 1", name,
                     just_outside ? fmt::format("{}", a) : fmt::format("{:.6g}", a));
}
std::string acos_domain(std::span<const double> a) { return cosine_range("ACOS", a[0]); }
std::string asin_domain(std::span<const double> a) { return cosine_range("ASIN", a[0]); }
std::string sqrt_domain(std::span<const double> a) { return a[0] < 0.0 ? fmt::format("SQRT of {:.6g}", a[0]) : ""; }
std::string log_domain(std::span<const double> a) { return a[0] <= 0.0 ? fmt::format("LOG of {:.6g}", a[0]) : ""; }
std::string log10_domain(std::span<const double> a) { return a[0] <= 0.0 ? fmt::format("LOG10 of {:.6g}", a[0]) : ""; }
std::string mod_domain(std::span<const double> a) { return a[1] == 0.0 ? "MOD with the divisor 0" : ""; }
std::string power_domain(std::span<const double> a) {
  const bool no_value = (a[0] == 0.0 && a[1] < 0.0) || (a[0] < 0.0 && std::trunc(a[1]) != a[1]);
  return no_value && !std::isnan(a[1]) ? fmt::format("{:.6g} to the power {:.6g}", a[0], a[1]) : "";
}

constexpr std::array elementary_table = {
    flat_at_kinks(kinked(
        function<1>("ABS", {"a", "the size of a, |a|", "as a", "its derivative at a = 0 is taken as 0"}, absolute),
        sign_of_first)),
    growing_like_a_root(
        function<1>("ACOS", {"a", "the angle, 0 … π, whose cosine is a", "rad", "a  −1 … 1"}, arc_cosine, acos_domain)),
    growing_like_a_root(function<1>("ASIN", {"a", "the angle, −π/2 … π/2, whose sine is a", "rad", "a  −1 … 1"},
                                    arc_sine, asin_domain)),
    function<1>("ATAN", {"a", "the angle, −π/2 … π/2, whose tangent is a", "rad", ""}, arc_tangent),
    with_switches(function<2>("ATAN2",
                              {"y, x", "the angle, −π … π, of the point (x, y) seen from the origin", "rad",
                               "note the order: y comes first"},
                              angle_of_point),
                  angle_switches),
    function<1>("COS", {"a", "cosine", "1", "a  [rad]; write COS(30D) for degrees"}, cosine_of),
    function<1>("SIN", {"a", "sine", "1", "a  [rad]; write SIN(30D) for degrees"}, sine_of),
    function<1>("TAN", {"a", "tangent", "1", "a  [rad]; write TAN(30D) for degrees"}, tangent),
    function<1>("COSH", {"a", "hyperbolic cosine", "1", ""}, hyperbolic_cosine),
    function<1>("SINH", {"a", "hyperbolic sine", "1", ""}, hyperbolic_sine),
    function<1>("TANH", {"a", "hyperbolic tangent", "1", ""}, hyperbolic_tangent),
    function<1>("EXP", {"a", "e to the power a", "1", ""}, exponential),
    growing_like_a_root(
        function<1>("SQRT", {"a", "square root", "root of that of a", "a  0 or more; at 0 there is no derivative"},
                    square_root, sqrt_domain)),
    function<1>("LOG", {"a", "natural logarithm", "1", "a  above 0"}, natural_logarithm, log_domain),
    function<1>("LOG10", {"a", "logarithm to the base 10", "1", "a  above 0"}, decimal_logarithm, log10_domain),
    kinked(function<1>("AINT", {"a", "a without its fraction, towards 0", "as a", "its derivative is 0"}, truncated,
                       defined_everywhere, ZeroPartial::flat),
           truncation_switches),
    kinked(
        function<1>("ANINT", {"a", "the whole number nearest to a, halves away from 0", "as a", "its derivative is 0"},
                    rounded, defined_everywhere, ZeroPartial::flat),
        rounding_switches),
    kinked(function<2>("DIM", {"a, b", "a − b where that is positive, else 0", "as a, b", ""}, positive_difference,
                       defined_everywhere, ZeroPartial::flat),
           difference_switches),
    kinked(list_function("MAX", {"a, b …", "the largest", "as a, b", "two values or more"}, 2, most_arguments,
                         largest_of, ZeroPartial::flat),
           largest_switches),
    kinked(list_function("MIN", {"a, b …", "the smallest", "as a, b", "two values or more"}, 2, most_arguments,
                         smallest, ZeroPartial::flat),
           smallest_switches),
    kinked(function<2>("MOD", {"a, b", "the remainder of a divided by b, with the sign of a", "as a", "b  not 0"},
                       remainder_of_division, mod_domain, ZeroPartial::flat),
           remainder_switches),
    flat_at_kinks(kinked(
        function<2>("SIGN", {"a, b", "the size of a with the sign of b, plus where b = 0", "as a", ""}, with_sign_of),
        sign_switches)),
};
constexpr Function power_operator = function<2>("**", {}, power_of, power_domain);

}  // namespace

std::span<const Function> elementary_functions() { return elementary_table; }
const Function& variable_power() { return power_operator; }

}  // namespace dynalin

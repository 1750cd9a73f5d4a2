// Series and harmonic signals: POLY, CHEBY, FORSIN, FORCOS, SHF, SWEEP. Smooth but for the corners
// of SWEEP.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "expression/functions_define.h"
#include "expression/functions_steps.h"

namespace dynalin {

namespace {

// POLY(x, x0, a0, a1, …) = Σ a_j (x − x0)^j, by Horner's rule.
constexpr auto polynomial = []<class T>(std::span<const T> a) {
  const T u = a[0] - a[1];
  T sum = a.back();
  for (std::size_t j = a.size() - 1; j-- > 2;) sum = sum * u + a[j];
  return sum;
};

// CHEBY(x, x0, a0, a1, …) = Σ a_j T_j(x − x0) with T0 = 1, T1 = u, T_{j+1} = 2 u T_j − T_{j−1} for
// any u.
constexpr auto chebyshev = []<class T>(std::span<const T> a) {
  const T u = a[0] - a[1];
  T before(1.0), now = u, sum = a[2];
  for (std::size_t j = 3; j < a.size(); ++j) {
    sum += a[j] * now;
    const T next = 2.0 * u * now - before;
    before = now;
    now = next;
  }
  return sum;
};

// FORCOS(x, x0, w, a0, a1, …) = a0 + Σ a_j COS(j w (x − x0)), FORSIN the same with SIN.
constexpr auto cosine_series = []<class T>(std::span<const T> a) {
  using std::cos;
  const T phase = a[2] * (a[0] - a[1]);
  T sum = a[3];
  for (std::size_t j = 4; j < a.size(); ++j) {
    sum += a[j] * cos(T(static_cast<double>(j - 3) * phase));
  }
  return sum;
};
constexpr auto sine_series = []<class T>(std::span<const T> a) {
  using std::sin;
  const T phase = a[2] * (a[0] - a[1]);
  T sum = a[3];
  for (std::size_t j = 4; j < a.size(); ++j) {
    sum += a[j] * sin(T(static_cast<double>(j - 3) * phase));
  }
  return sum;
};

// SHF(x, x0, a, w, phi, b) = a SIN(w (x − x0) − phi) + b.
constexpr auto simple_harmonic = []<class T>(const T& x, const T& x0, const T& a, const T& w, const T& phi,
                                             const T& b) {
  using std::sin;
  return T(a * sin(T(w * (x - x0) - phi)) + b);
};

// SWEEP(x, a, x0, f0, x1, f1, dx) = STEP5(x, x0, 0, x0 + dx, 1) a SIN(2π F(x)), where F is the
// integral of a frequency that is f0 before x0, grows linearly to f1 at x1, and stays there. The
// frequency has corners at x0 and x1, so the second derivative of the value jumps there; the
// constant side is used.
constexpr auto sweep = []<class T>(const T& x, const T& a, const T& x0, const T& f0, const T& x1, const T& f1,
                                   const T& dx) {
  using std::sin;
  if (!(value_of(x1) >= value_of(x0)) || !(value_of(dx) > 0.0)) return undefined<T>();
  T turns = f0 * x;
  if (value_of(x) >= value_of(x1)) {
    turns = f1 * x - (f1 - f0) * (x1 + x0) * 0.5;
  } else if (value_of(x) > value_of(x0)) {
    const T u = x - x0;
    turns = f0 * x + (f1 - f0) * u * u / (2.0 * (x1 - x0));
  }
  const T ramp = steps::quintic(x, x0, T(0.0), T(x0 + dx), T(1.0));
  return T(ramp * a * sin(T(2.0 * std::numbers::pi * turns)));
};

// The sine comes in from x0 to x0 + dx; at x1 the frequency has its corner.
void sweep_switches(std::span<const double> a, SwitchList& out) {
  out.add(a[0] - a[2]);
  out.add(a[0] - (a[2] + a[6]));
  out.add(a[3] == a[5] ? 1.0 : a[0] - a[4]);
}

std::string sweep_domain(std::span<const double> a) {
  if (a[4] < a[2]) return fmt::format("SWEEP with x1 = {:.6g} below x0 = {:.6g}", a[4], a[2]);
  if (a[6] <= 0.0) return fmt::format("SWEEP with dx = {:.6g} where it needs dx > 0", a[6]);
  return {};
}

constexpr std::array series_table = {
    list_function(
        "POLY",
        {"x, x0, a0 [, a1 …]", "a0 + a1 (x − x0) + a2 (x − x0)² + …", "as a0", "x0  where it is expanded [as x]"}, 3,
        33, polynomial),
    list_function("CHEBY",
                  {"x, x0, a0 [, a1 …]", "a0 T0 + a1 T1 + … with the Chebyshev polynomials of x − x0", "as a0",
                   "x0  where it is expanded [as x]"},
                  3, 33, chebyshev),
    list_function("FORSIN",
                  {"x, x0, w, a0 [, a1 …]", "a0 + a1 sin(w (x − x0)) + a2 sin(2 w (x − x0)) + …", "as a0",
                   "x0  where the phase is zero [as x]\n"
                   "w   frequency [rad per unit of x]"},
                  4, most_arguments, sine_series),
    list_function("FORCOS",
                  {"x, x0, w, a0 [, a1 …]", "a0 + a1 cos(w (x − x0)) + a2 cos(2 w (x − x0)) + …", "as a0",
                   "x0  where the phase is zero [as x]\n"
                   "w   frequency [rad per unit of x]"},
                  4, most_arguments, cosine_series),
    function<6>("SHF",
                {"x, x0, a, w, p, b", "a sin(w (x − x0) − p) + b", "as a, b",
                 "x0  where the phase is −p [as x]\n"
                 "a   amplitude\n"
                 "w   frequency [rad per unit of x]\n"
                 "p   phase [rad]\n"
                 "b   mean value"},
                simple_harmonic),
    with_switches(function<7>("SWEEP",
                              {"x, a, x0, f0, x1, f1, dx",
                               "a sine of amplitude a whose frequency goes from f0 at x0 to f1 at x1", "as a",
                               "x       often TIME\n"
                               "a       amplitude\n"
                               "x0, x1  where the frequency begins and ends to change [as x]\n"
                               "f0, f1  frequencies [cycles per unit of x]\n"
                               "dx      over which the sine comes in, from x0 on [as x]"},
                              sweep, sweep_domain),
                  sweep_switches),
};

}  // namespace

std::span<const Function> series_functions() { return series_table; }

}  // namespace dynalin

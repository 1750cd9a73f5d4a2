// Functions made of pieces: the steps STEP, STEP5, HAVSIN and the contacts IMPACT, BISTOP.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "expression/functions_define.h"
#include "expression/functions_power.h"
#include "expression/functions_steps.h"

namespace dynalin {

namespace {

// HAVSIN(x, x0, h0, x1, h1) = (h0 + h1)/2 + (h1 − h0)/2 SIN(π s − π/2), constant outside.
constexpr auto haversine = []<class T>(const T& x, const T& x0, const T& h0, const T& x1, const T& h1) {
  return steps::between(x, x0, h0, x1, h1, [](const T& s) {
    using std::sin;
    return T(0.5 + 0.5 * sin(T(std::numbers::pi * s - 0.5 * std::numbers::pi)));
  });
};

// Force of a stop that is penetrated by p > 0 at the rate p′, never pulling:
//     MAX(0, k p ** e + c(p) p′)      c(p): a cubic step from 0 at p = 0 to cmax at p = d
// Where the force is held at 0 its derivatives are 0.
struct Stop {
  template <class T>
  static T force(const T& p, const T& pdot, const T& k, const T& e, const T& cmax, const T& d) {
    const T f = k * power(p, e) + steps::cubic(p, T(0.0), T(0.0), d, cmax) * pdot;
    return value_of(f) <= 0.0 ? T(0.0) : f;
  }
  static bool is_defined(double k, double e, double cmax, double d) {
    return k >= 0.0 && e > 0.0 && cmax >= 0.0 && d > 0.0;
  }
  static std::string domain(std::string_view name, std::span<const double> k_e_cmax_d) {
    constexpr std::array bounds = {"k ≥ 0", "e > 0", "cmax ≥ 0", "d > 0"};
    constexpr std::array names = {"k", "e", "cmax", "d"};
    for (std::size_t n = 0; n < 4; ++n) {
      const double a = k_e_cmax_d[n];
      const bool may_be_zero = n == 0 || n == 2;
      if (a < 0.0 || (a == 0.0 && !may_be_zero)) {
        return fmt::format("{} with {} = {:.6g} where it needs {}", name, names[n], a, bounds[n]);
      }
    }
    return {};
  }
  // The sign of the force before it is held at 0; positive outside, where it is left with the contact.
  static double hold(double p, double pdot, double k, double e, double cmax, double d) {
    if (!(p > 0.0)) return 1.0;
    const double push = k * std::pow(p, e), pull = -steps::cubic(p, 0.0, 0.0, d, cmax) * pdot;
    return pull > 0.0 ? (push - pull) / (push + pull) : 1.0;
  }
  // Where the damping is in full; nowhere without damping, and of no consequence where the force is held.
  static void add_full_damping(double p, double cmax, double d, double hold, SwitchList& out) {
    out.add(cmax == 0.0 ? 1.0 : p - d, hold > 0.0);
  }
};

// IMPACT(x, x′, x1, k, e, cmax, d): a stop below x1.
//     x < x1: MAX(0, k (x1 − x) ** e − STEP(x, x1 − d, cmax, x1, 0) x′)        x ≥ x1: 0, with
//     derivative 0
constexpr auto impact = []<class T>(const T& x, const T& xdot, const T& x1, const T& k, const T& e, const T& cmax,
                                    const T& d) {
  if (!Stop::is_defined(value_of(k), value_of(e), value_of(cmax), value_of(d))) {
    return undefined<T>();
  }
  if (value_of(x) >= value_of(x1)) return T(0.0);
  return Stop::force(T(x1 - x), T(-xdot), k, e, cmax, d);
};
void impact_switches(std::span<const double> a, SwitchList& out) {
  const double p = a[2] - a[0];
  out.add(p);
  const double hold = Stop::hold(p, -a[1], a[3], a[4], a[5], a[6]);
  out.add(hold);
  Stop::add_full_damping(p, a[5], a[6], hold, out);
}

// BISTOP(x, x′, x1, x2, k, e, cmax, d): a stop below x1 and one above x2, nothing between.
//     x > x2: MIN(0, −k (x − x2) ** e − STEP(x, x2, 0, x2 + d, cmax) x′)       x1 ≤ x ≤ x2: 0, with
//     derivative 0
constexpr auto two_stops = []<class T>(const T& x, const T& xdot, const T& x1, const T& x2, const T& k, const T& e,
                                       const T& cmax, const T& d) {
  if (!Stop::is_defined(value_of(k), value_of(e), value_of(cmax), value_of(d)) || value_of(x1) > value_of(x2)) {
    return undefined<T>();
  }
  if (value_of(x) < value_of(x1)) return Stop::force(T(x1 - x), T(-xdot), k, e, cmax, d);
  if (value_of(x) <= value_of(x2)) return T(0.0);
  return T(-Stop::force(T(x - x2), xdot, k, e, cmax, d));
};
void bistop_switches(std::span<const double> a, SwitchList& out) {
  const double below = a[2] - a[0], above = a[0] - a[3];
  out.add(below);
  out.add(above);
  const double hold = Stop::hold(std::max(below, above), below > above ? -a[1] : a[1], a[4], a[5], a[6], a[7]);
  out.add(hold);
  Stop::add_full_damping(below, a[6], a[7], hold, out);
  Stop::add_full_damping(above, a[6], a[7], hold, out);
}

std::string step_domain_of(std::string_view name, std::span<const double> a) {
  return a[1] == a[3] ? fmt::format("{} with x0 = x1 = {:.6g}", name, a[1]) : "";
}
std::string step_domain(std::span<const double> a) { return step_domain_of("STEP", a); }
std::string step5_domain(std::span<const double> a) { return step_domain_of("STEP5", a); }
std::string havsin_domain(std::span<const double> a) { return step_domain_of("HAVSIN", a); }
std::string impact_domain(std::span<const double> a) { return Stop::domain("IMPACT", a.subspan(3)); }
std::string bistop_domain(std::span<const double> a) {
  if (a[2] > a[3]) return fmt::format("BISTOP with x1 = {:.6g} above x2 = {:.6g}", a[2], a[3]);
  return Stop::domain("BISTOP", a.subspan(4));
}

constexpr std::string_view step_arguments =
    "x       what the step depends on, often TIME\n"
    "x0, x1  where it begins and ends [as x]\n"
    "h0, h1  values before and behind";
constexpr std::array contact_table = {
    with_switches(function<5>("STEP",
                              {"x, x0, h0, x1, h1", "h0 up to x0, h1 from x1 on, between them a cubic with level ends",
                               "as h0, h1", step_arguments},
                              steps::cubic, step_domain, ZeroPartial::flat),
                  steps::ends),
    with_switches(
        function<5>("STEP5",
                    {"x, x0, h0, x1, h1",
                     "h0 up to x0, h1 from x1 on, between them a quintic with ends that are level and not curved",
                     "as h0, h1", step_arguments},
                    steps::quintic, step5_domain, ZeroPartial::flat),
        steps::ends),
    with_switches(function<5>("HAVSIN",
                              {"x, x0, h0, x1, h1", "h0 up to x0, h1 from x1 on, between them half a sine wave",
                               "as h0, h1", step_arguments},
                              haversine, havsin_domain, ZeroPartial::flat),
                  steps::ends),
    kinked(function<7>(
               "IMPACT",
               {"x, v, x1, k, e, c, d", "the force of a stop at x1 that pushes back while x < x1, else 0", "as k·xᵉ",
                "x   distance, DX(20, 1) for example [length]\n"
                "v   its rate, VX(20, 1) [length/time]\n"
                "x1  where the stop begins [length]\n"
                "k   stiffness: the force is k (x1 − x)ᵉ [force/lengthᵉ]\n"
                "e   exponent, above 0; below 1 the stiffness at first contact is infinite\n"
                "c   largest damping coefficient [force·time/length]\n"
                "d   depth at which the damping is in full [length]; it grows like STEP"},
               impact, impact_domain, ZeroPartial::flat),
           impact_switches),
    kinked(
        function<8>("BISTOP",
                    {"x, v, x1, x2, k, e, c, d",
                     "the force of two stops that push back where x < x1 and where x > x2, between them 0", "as k·xᵉ",
                     "x       distance [length]\n"
                     "v       its rate [length/time]\n"
                     "x1, x2  where the stops begin, x1 ≤ x2 [length]\n"
                     "k       stiffness: the force is k pᵉ at the depth p [force/lengthᵉ]\n"
                     "e       exponent, above 0\n"
                     "c       largest damping coefficient [force·time/length]\n"
                     "d       depth at which the damping is in full [length]; it grows like STEP"},
                    two_stops, bistop_domain, ZeroPartial::flat),
        bistop_switches),
};

}  // namespace

std::span<const Function> contact_functions() { return contact_table; }

}  // namespace dynalin

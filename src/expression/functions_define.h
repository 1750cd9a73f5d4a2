// How a formula over any scalar becomes an entry of the function table.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "expression/functions.h"

namespace dynalin {

using DomainCheck = std::string (*)(std::span<const double>);
inline std::string defined_everywhere(std::span<const double>) { return {}; }

// `formula` takes the arguments one by one.
template <std::size_t count, class Formula>
struct FixedArguments {
  template <class S>
  static S call(std::span<const S> a) {
    return [&]<std::size_t... k>(std::index_sequence<k...>) { return S(Formula{}(a[k]...)); }
    (std::make_index_sequence<count>{});
  }
};
// `formula` takes them as a span.
template <class Formula>
struct ArgumentList {
  template <class S>
  static S call(std::span<const S> a) {
    return S(Formula{}(a));
  }
};

template <class Call>
constexpr Function make_function(std::string_view name, std::uint8_t minimum, std::uint8_t maximum, DomainCheck domain,
                                 ZeroPartial zero, FunctionText text) {
  return {.name = name,
          .minimum_arguments = minimum,
          .maximum_arguments = maximum,
          .zero_partial = zero,
          .text = text,
          .on_double = &Call::template call<double>,
          .on_taylor = &Call::template call<TimeTaylor<double>>,
          .on_seeded = &Call::template call<Seeded>,
          .on_seeded_taylor = &Call::template call<TimeTaylor<Seeded>>,
          .domain = domain};
}

// A function of `count` arguments.
template <std::size_t count, class Formula>
constexpr Function function(std::string_view name, FunctionText text, Formula, DomainCheck domain = defined_everywhere,
                            ZeroPartial zero = ZeroPartial::stationary) {
  constexpr auto n = static_cast<std::uint8_t>(count);
  return make_function<FixedArguments<count, Formula>>(name, n, n, domain, zero, text);
}
// A function of a list of arguments.
template <class Formula>
constexpr Function list_function(std::string_view name, FunctionText text, std::uint8_t minimum, std::uint8_t maximum,
                                 Formula, ZeroPartial zero = ZeroPartial::stationary) {
  return make_function<ArgumentList<Formula>>(name, minimum, maximum, defined_everywhere, zero, text);
}

using SwitchingFunctions = void (*)(std::span<const double>, SwitchList&);

// Made of pieces.
constexpr Function with_switches(Function f, SwitchingFunctions switches) {
  f.switches = switches;
  return f;
}
// Of pieces that meet in kinks or jumps whatever the arguments are.
constexpr Function kinked(Function f, SwitchingFunctions switches) {
  f.kinked = true;
  return with_switches(f, switches);
}
// In kinks where its slope counts as zero.
constexpr Function flat_at_kinks(Function f) {
  f.flat_at_kinks = true;
  return f;
}
// Like a root where its slope is infinite.
constexpr Function growing_like_a_root(Function f) {
  f.growth_at_infinity = 0.5;
  return f;
}

template <class T>
T undefined() {
  return T(std::numeric_limits<double>::quiet_NaN());
}

// Whether a scalar carries neither a partial nor a time derivative: it is a plain number here.
inline bool is_plain(double) { return true; }
template <std::size_t N>
bool is_plain(const Dual<N>& x) {
  for (double p : x.partial) {
    if (p != 0.0) return false;
  }
  return true;
}
template <class T>
bool is_plain(const TimeTaylor<T>& x) {
  return is_plain(x.value) && is_plain(x.rate) && is_plain(x.acceleration) && value_of(x.rate) == 0.0 &&
         value_of(x.acceleration) == 0.0;
}

}  // namespace dynalin

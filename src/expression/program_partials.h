// The partial derivatives of one node of a program with respect to its operands.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "expression/program.h"

namespace dynalin {

using Taylor = TimeTaylor<double>;

// --- one vocabulary for the two scalars of a program
// ---------------------------------------------------
inline bool is_zero(double x) { return x == 0.0; }
inline bool is_zero(const Taylor& x) { return x.value == 0.0 && x.rate == 0.0 && x.acceleration == 0.0; }
inline bool is_finite(double x) { return std::isfinite(x); }
inline bool is_finite(const Taylor& x) {
  return std::isfinite(x.value) && std::isfinite(x.rate) && std::isfinite(x.acceleration);
}
// A quantity that does not change in time needs no time derivatives, and those of a function of it
// are 0 even where the function has an infinite slope.
inline bool is_at_rest(double) { return true; }
inline bool is_at_rest(const Taylor& x) { return x.rate == 0.0 && x.acceleration == 0.0; }

inline double power_at(double x, double n) { return std::pow(x, n); }
inline Taylor power_at(const Taylor& x, double n) { return is_at_rest(x) ? Taylor(std::pow(x.value, n)) : pow(x, n); }

// The value is that of the plain division: x / x is 1 along the motion too, and ACOS of it is
// defined.
inline double quotient(double a, double b) { return a / b; }
inline Taylor quotient(const Taylor& a, const Taylor& b) {
  Taylor q = a / b;
  q.value = a.value / b.value;
  return q;
}

// The scalar that carries partial derivatives of T, and how it is taken apart again. A constant
// seed is enough: the dual part of a formula on TimeTaylor<Dual> is the partial derivative together
// with its own time derivatives.
template <class T>
struct SeededScalar;
template <>
struct SeededScalar<double> {
  using Type = Seeded;
  static Type plain(double x) { return Seeded(x); }
  static void seed(Type& x, std::size_t k) { x.partial[k] = 1.0; }
  static double partial(const Type& x, std::size_t k) { return x.partial[k]; }
};
template <>
struct SeededScalar<Taylor> {
  using Type = TimeTaylor<Seeded>;
  static Type plain(const Taylor& x) { return {Seeded(x.value), Seeded(x.rate), Seeded(x.acceleration)}; }
  static void seed(Type& x, std::size_t k) { x.value.partial[k] = 1.0; }
  static Taylor partial(const Type& x, std::size_t k) {
    return {x.value.partial[k], x.rate.partial[k], x.acceleration.partial[k]};
  }
};

// Partials of one call, a pass of `seeds_per_pass` operands at a time; S is the scalar of the
// formula.
template <class S, std::size_t capacity, class T, class Visit>
void visit_call_in_passes(const ExpressionProgram& program, const Function& function,
                          std::span<const std::int32_t> operands, const std::vector<T>& value, Visit& visit) {
  using Scalar = SeededScalar<S>;
  using Argument = typename Scalar::Type;
  const auto node = [&](std::size_t k) { return static_cast<std::size_t>(operands[k]); };
  const auto plain = [&](std::size_t k) {
    if constexpr (std::is_same_v<S, T>) {
      return Scalar::plain(value[node(k)]);
    } else {
      return Scalar::plain(value_of(value[node(k)]));
    }
  };
  std::array<Argument, capacity> arguments;
  for (std::size_t k = 0; k < operands.size(); ++k) arguments[k] = plain(k);
  for (std::size_t k = 0; k < operands.size();) {
    std::array<std::size_t, seeds_per_pass> seeded{};
    std::size_t count = 0;
    for (; k < operands.size() && count < seeds_per_pass; ++k) {
      if (program.nodes()[node(k)].kind == ExpressionNode::Kind::constant) continue;
      Scalar::seed(arguments[k], count);
      seeded[count++] = k;
    }
    if (count == 0) return;
    const Argument result = function(std::span<const Argument>(arguments.data(), operands.size()));
    const bool no_slope = std::is_same_v<T, Taylor> && function.is_size && value_of(result) == 0.0;
    for (std::size_t s = 0; s < count; ++s) {
      const S partial = no_slope ? S(std::numeric_limits<double>::quiet_NaN()) : Scalar::partial(result, s);
      const bool independent = function.zero_partial == ZeroPartial::flat && is_zero(partial);
      if (!independent) visit(node(seeded[s]), T(partial));
      arguments[seeded[s]] = plain(seeded[s]);
    }
  }
}

template <std::size_t capacity, class T, class Visit>
void visit_call(const ExpressionProgram& program, const Function& function, std::span<const std::int32_t> operands,
                const std::vector<T>& value, Visit& visit) {
  bool at_rest = true;
  for (const std::int32_t k : operands) {
    at_rest = at_rest && is_at_rest(value[static_cast<std::size_t>(k)]);
  }
  if (at_rest) {
    visit_call_in_passes<double, capacity>(program, function, operands, value, visit);
  } else {
    visit_call_in_passes<T, capacity>(program, function, operands, value, visit);
  }
}

// Calls visit(operand node, partial) for every operand on which the node depends. Operands that
// cannot matter, constants and those multiplied by a constant zero, are left out, so that no
// infinity meets them.
template <class T, class Visit>
void visit_partials(const ExpressionProgram& program, const ExpressionNode& node, const std::vector<T>& value,
                    Visit visit) {
  using Kind = ExpressionNode::Kind;
  const auto a = static_cast<std::size_t>(node.a), b = static_cast<std::size_t>(node.b);
  const auto varies = [&](std::size_t k) { return program.nodes()[k].kind != Kind::constant; };
  const auto is_constant_zero = [&](std::size_t k) { return !varies(k) && is_zero(value[k]); };
  switch (node.kind) {
    case Kind::constant:
    case Kind::atom:
    case Kind::branch:
    case Kind::jump:
      return;
    case Kind::negate:
      return visit(a, -1.0);
    case Kind::add:
      if (varies(a)) visit(a, 1.0);
      if (varies(b)) visit(b, 1.0);
      return;
    case Kind::subtract:
      if (varies(a)) visit(a, 1.0);
      if (varies(b)) visit(b, -1.0);
      return;
    case Kind::multiply:
      if (varies(a) && !is_constant_zero(b)) visit(a, value[b]);
      if (varies(b) && !is_constant_zero(a)) visit(b, value[a]);
      return;
    case Kind::divide: {
      const T inverse = 1.0 / value[b];
      if (varies(a)) visit(a, inverse);
      if (varies(b) && !is_constant_zero(a)) visit(b, -(value[a] * inverse) * inverse);
      return;
    }
    case Kind::power:
      if (const double exponent = program.constant_of(node); exponent != 0.0) {
        visit(a, T(exponent * power_at(value[a], exponent - 1.0)));
      }
      return;
    case Kind::call: {
      const auto operands = program.operands().subspan(b, a);
      // Few functions have long lists; the others need not clear so much memory.
      if (a <= 8) return visit_call<8>(program, program.function_of(node), operands, value, visit);
      return visit_call<most_arguments>(program, program.function_of(node), operands, value, visit);
    }
    case Kind::spline: {
      using Scalar = SeededScalar<T>;
      const auto x = static_cast<std::size_t>(program.operands()[b]),
                 z = static_cast<std::size_t>(program.operands()[b + 1]);
      auto seeded_x = Scalar::plain(value[x]), seeded_z = Scalar::plain(value[z]);
      Scalar::seed(seeded_x, 0), Scalar::seed(seeded_z, 1);
      const auto result = program.splines()[a].evaluate(seeded_x, seeded_z);
      if (varies(x)) visit(x, Scalar::partial(result, 0));
      if (varies(z)) visit(z, Scalar::partial(result, 1));
      return;
    }
    // An input that it does not read here is none, so that no undefined gradient of it counts.
    case Kind::routine: {
      const RoutineUse& use = program.routines()[a];
      const auto inputs = program.inputs_of(node, value);
      const auto partials = use.routine->partials(inputs, use.which);
      for (std::size_t k = 0; k < inputs.size(); ++k) {
        if (!is_zero(partials[k])) visit(static_cast<std::size_t>(inputs.read[k]), partials[k]);
      }
      return;
    }
    case Kind::merge: {
      const double selection = value_of(value[a]);
      if (std::isnan(selection)) return;
      const auto result = program.operands()[b + static_cast<std::size_t>(selection)];
      return visit(static_cast<std::size_t>(result), 1.0);
    }
  }
}

}  // namespace dynalin

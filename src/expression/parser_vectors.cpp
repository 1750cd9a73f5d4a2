// Vectors in expressions: types are checked here, and the builder takes them apart. Functions that name a marker or a
// spline behind other arguments are read here too, for the id must be a written number.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "expression/parser.h"
#include "expression/vector_functions.h"

namespace dynalin {

bool ExpressionParser::check_scalar(const Operand& operand, std::string_view where) {
  if (!operand.is_vector()) return true;
  if (!operand.unknown) {
    diagnostics_.error("vector-mismatch", operand.at, fmt::format("{} is a number, here is a vector", where),
                       "a dot product v*w, MAG(v) or a component such as DX makes a number of a vector");
  }
  return false;
}

Operand ExpressionParser::apply_to_vectors(const Pending& operation, const Operand& first, const Operand& last) {
  using Kind = ExpressionNode::Kind;
  const Span at = join(first.at, last.at);
  if (first.unknown || last.unknown) return builder_.placeholder(at);
  const std::string_view sign = operation.sign;
  const bool v = first.is_vector(), w = last.is_vector();
  if (sign == "+" && v && w) return builder_.combine(Kind::add, first, last);
  if (sign == "-" && v && w) return builder_.combine(Kind::subtract, first, last);
  if (sign == "*" && v && w) return builder_.dot(first, last);
  if (sign == "*") return v ? builder_.scale(Kind::multiply, first, last) : builder_.scale(Kind::multiply, last, first);
  if (sign == "/" && v && !w) return builder_.scale(Kind::divide, first, last);
  if (sign == "%" && v && w) return builder_.cross(first, last);
  const auto type = [](bool is_vector) { return is_vector ? "a vector" : "a number"; };
  diagnostics_.error("vector-mismatch", operation.at,
                     fmt::format("'{}' does not join {} and {}", sign, type(v), type(w)),
                     sign == "%" ? "% is the cross product of two vectors" : "");
  return builder_.placeholder(at);
}

Operand ExpressionParser::close_vector(const Pending& vector, const Span& at) {
  const std::span components = std::span(operands_).subspan(vector.first_operand);
  if (components.size() != 3) {
    diagnostics_.error("wrong-count", at, fmt::format("a vector has 3 components, here are {}", components.size()));
    return builder_.placeholder(at);
  }
  for (const Operand& c : components) {
    if (!check_scalar(c, "a component of a vector")) return builder_.placeholder(at);
  }
  return builder_.vector(components[0], components[1], components[2], at);
}

std::optional<std::int32_t> ExpressionParser::constant_id(const Operand& operand, std::string_view meaning,
                                                          std::int32_t least) {
  if (operand.unknown) return std::nullopt;
  const auto value = operand.is_vector() ? std::nullopt : builder_.constant_value(operand);
  if (!value || *value != std::floor(*value) || *value < least || *value > std::numeric_limits<std::int32_t>::max()) {
    diagnostics_.error("expected-integer", operand.at, fmt::format("{} is needed here, a whole number", meaning));
    return std::nullopt;
  }
  return static_cast<std::int32_t>(*value);
}

// Components of an axis of marker i in the axes of marker j, whose ids `markers` holds.
Operand ExpressionParser::marker_axis(std::size_t axis, const Atom& markers) {
  static constexpr std::array<std::string_view, 3> names = {"UVX", "UVY", "UVZ"};
  std::array<Operand, 3> parts;
  for (std::size_t k = 0; k < 3; ++k) {
    Atom atom = markers;
    atom.function = find_atom_function(find_vector_atom(names[axis])->components[k]);
    parts[k] = builder_.atom(atom);
  }
  return builder_.vector(parts[0], parts[1], parts[2], markers.at);
}

Operand ExpressionParser::close_special(const Pending& call, const Span& at) {
  const std::span<const Operand> arguments = std::span(operands_).subspan(call.first_operand);
  const SpecialFunction& f = *call.special;
  if (arguments.size() < f.minimum_arguments || arguments.size() > f.maximum_arguments) {
    report_count(at, f.name, f.minimum_arguments, f.maximum_arguments, arguments.size());
    return builder_.placeholder(at);
  }
  using Kind = SpecialFunction::Kind;
  if (f.kind == Kind::akispl || f.kind == Kind::cubspl || f.kind == Kind::interp) {
    return close_spline(call, arguments, at);
  }
  if (f.kind == Kind::curve) return close_curve(arguments, at);
  if (f.kind == Kind::spectrum) return close_spectrum(arguments, at);
  if (f.kind == Kind::orientation) return close_orientation(arguments, at);
  const Operand v = arguments[0];
  if (v.unknown) return builder_.placeholder(at);
  if (!v.is_vector()) {
    diagnostics_.error("vector-mismatch", v.at, fmt::format("{} takes a vector, here is a number", f.name));
    return builder_.placeholder(at);
  }
  if (f.kind == Kind::unit) return builder_.unit(v, at);
  if (f.kind == Kind::magnitude) return builder_.magnitude(v, at);

  Atom markers;
  markers.at = at;
  markers.argument_count = static_cast<std::uint8_t>(arguments.size() - 1);
  for (std::size_t k = 1; k < arguments.size(); ++k) {
    const auto id = constant_id(arguments[k], "the id of a marker", 0);
    if (!id) return builder_.placeholder(at);
    markers.argument[k - 1] = *id;
    markers.set_argument_at(k - 1, arguments[k].at);
  }
  return builder_.transform({marker_axis(0, markers), marker_axis(1, markers), marker_axis(2, markers)}, v, at);
}

Operand ExpressionParser::close_spline(const Pending& call, std::span<const Operand> arguments, const Span& at) {
  using Kind = SpecialFunction::Kind;
  const Kind kind = call.special->kind;
  SplineUse use;
  use.at = at;
  use.id_at = arguments[2].at;
  const auto id = constant_id(arguments[2], "the id of a SPLINE", 1);
  const auto derivative = arguments.size() > 3 ? constant_id(arguments[3], "the order of a derivative, 0 to 2,", 0)
                                               : std::optional<std::int32_t>(0);
  if (derivative && *derivative > 2) {
    diagnostics_.error("argument-range", arguments[3].at,
                       fmt::format("the order of a derivative is 0, 1 or 2, here is {}", *derivative));
    return builder_.placeholder(at);
  }
  use.method = kind == Kind::akispl ? SplineMethod::akima : SplineMethod::cubic;
  Operand z = arguments[1];
  if (kind == Kind::interp) {
    const auto method = constant_id(arguments[1], "the method of INTERP, 1 linear or 3 cubic,", 1);
    if (method && *method != 1 && *method != 3) {
      diagnostics_.error("argument-range", arguments[1].at,
                         fmt::format("the method of INTERP is 1 (linear) or 3 (cubic), here is {}", *method));
      return builder_.placeholder(at);
    }
    if (!method) return builder_.placeholder(at);
    if (*method == 1) use.method = SplineMethod::linear;
    z = builder_.constant(0.0, arguments[1].at);
  }
  const bool scalars = check_scalar(arguments[0], fmt::format("the first argument of {}", call.special->name)) &&
                       check_scalar(z, fmt::format("the second argument of {}", call.special->name));
  if (!id || !derivative || !scalars || arguments[0].unknown || z.unknown) return builder_.placeholder(at);
  use.id = *id;
  use.derivative = *derivative;
  return builder_.spline(std::move(use), arguments[0], z);
}

Operand ExpressionParser::close_curve(std::span<const Operand> arguments, const Span& at) {
  const auto derivative = constant_id(arguments[1], "the order of a derivative, 0 to 2,", 0);
  const auto component = constant_id(arguments[2], "a component, 1 to 3 for x, y, z,", 1);
  const auto id = constant_id(arguments[3], "the id of a CURVE", 1);
  const auto in_range = [&](const std::optional<std::int32_t>& value, std::int32_t most, const Operand& operand,
                            std::string_view meaning) {
    if (value && *value > most) {
      diagnostics_.error("argument-range", operand.at, fmt::format("{}, here is {}", meaning, *value));
    }
    return value && *value <= most;
  };
  const bool order_fits = in_range(derivative, 2, arguments[1], "the order of a derivative is 0, 1 or 2");
  const bool component_fits = in_range(component, 3, arguments[2], "the component of a CURVE is 1, 2 or 3");
  const bool scalar = check_scalar(arguments[0], "the first argument of CURVE");
  if (!id || !order_fits || !component_fits || !scalar || arguments[0].unknown) return builder_.placeholder(at);
  SplineUse use;
  use.id = *id;
  use.derivative = *derivative;
  use.component = static_cast<std::size_t>(*component - 1);
  use.at = at;
  use.id_at = arguments[3].at;
  return builder_.spline(std::move(use), arguments[0], builder_.constant(0.0, at));
}

// All arguments but x are constants, each with its own range.
Operand ExpressionParser::close_spectrum(std::span<const Operand> arguments, const Span& at) {
  bool sound = check_scalar(arguments[0], "the first argument of INVPSD") && !arguments[0].unknown;
  const auto number = [&](std::size_t k) {
    const Operand& operand = arguments[k];
    if (operand.unknown || !check_scalar(operand, "an argument of INVPSD")) return std::optional<double>();
    const auto value = builder_.constant_value(operand);
    if (!value) {
      diagnostics_.error("expected-number", operand.at, fmt::format("argument {} of INVPSD is a constant", k + 1));
    }
    return value;
  };
  const auto require = [&](bool holds, std::size_t k, std::string_view meaning) {
    sound = sound && holds;
    if (!holds) {
      diagnostics_.error("argument-range", arguments[k].at,
                         fmt::format("argument {} of INVPSD is {}, here is {:g}", k + 1, meaning,
                                     *builder_.constant_value(arguments[k])));
    }
  };
  const auto id = constant_id(arguments[1], "the id of a SPLINE", 1);
  const auto low = number(2), high = number(3), count = number(4), flag = number(5), seed = number(6);
  if (low) require(*low >= 0, 2, "the lowest frequency, 0 or more");
  if (low && high) require(*high > *low, 3, "the highest frequency, above the lowest");
  if (count) {
    require(*count == std::floor(*count) && *count >= 2 && *count <= 199, 4, "how many frequencies, 2 to 199");
  }
  if (flag) require(*flag == 0 || *flag == 1, 5, "0 (lines between the points) or 1 (lines between their logarithms)");
  constexpr double most = 9007199254740992.0;  // up to which every whole number is one
  if (seed) require(std::abs(*seed) <= most, 6, "a seed of at most 2**53");
  if (!sound || !id || !low || !high || !count || !flag || !seed) return builder_.placeholder(at);
  SplineUse use;
  use.id = *id;
  use.spectrum =
      SpectrumBands{*low, *high, static_cast<std::int32_t>(*count), *flag == 1, static_cast<std::int64_t>(*seed)};
  use.at = at;
  use.id_at = arguments[1].at;
  return builder_.spline(std::move(use), arguments[0], builder_.constant(0.0, at));
}

}  // namespace dynalin

// ORIENT(system, component, i [, j]): one number of the orientation of marker i in the axes of marker j, made of the
// direction cosines R, whose columns are the axes of i.
//
//     1 … 6     angles of the body-fixed sequences 123, 231, 312, 132, 213, 321
//     7 … 12    of 121, 131, 212, 232, 313, 323
//     27        Euler parameters e0 ≥ 0, e1, e2, e3
#include <fmt/format.h>

#include "expression/parser.h"
#include "expression/vector_functions.h"

namespace dynalin {

namespace {

using Kind = ExpressionNode::Kind;

constexpr std::array<std::array<std::size_t, 3>, 12> sequences = {{{0, 1, 2},
                                                                   {1, 2, 0},
                                                                   {2, 0, 1},
                                                                   {0, 2, 1},
                                                                   {1, 0, 2},
                                                                   {2, 1, 0},
                                                                   {0, 1, 0},
                                                                   {0, 2, 0},
                                                                   {1, 0, 1},
                                                                   {1, 2, 1},
                                                                   {2, 0, 2},
                                                                   {2, 1, 2}}};
constexpr std::int32_t euler_parameters = 27, last_system = 29;

// Direction cosines and what is made of them, as nodes of the program.
class Cosines {
 public:
  Cosines(ProgramBuilder& builder, const std::array<Operand, 3>& axes, const Span& at)
      : builder_(builder), axes_(axes), at_(at) {}

  Operand entry(std::size_t row, std::size_t column, bool negative = false) const {
    const Operand e = axes_[column].component(row);
    return negative ? builder_.negate(e, at_) : e;
  }
  Operand call(std::string_view name, std::initializer_list<Operand> arguments) const {
    return builder_.call(*find_function(name), std::span(arguments.begin(), arguments.size()), at_);
  }

  Operand angle(const std::array<std::size_t, 3>& axis, std::int32_t which) const {
    const auto [a, b, c] = axis;
    const std::size_t other = 3 - a - b;
    const bool even = (b + 3 - a) % 3 == 1;
    if (a != c) {
      if (which == 1) return call("ATAN2", {entry(b, c, even), entry(c, c)});
      if (which == 2) return call("ASIN", {entry(a, c, !even)});
      return call("ATAN2", {entry(a, b, even), entry(a, a)});
    }
    if (which == 1) return call("ATAN2", {entry(b, a), entry(other, a, even)});
    if (which == 2) return call("ACOS", {entry(a, a)});
    return call("ATAN2", {entry(a, b), entry(a, other, !even)});
  }

  Operand euler_parameter(std::int32_t which) const {
    const auto sum = [&](const Operand& p, const Operand& q) { return builder_.binary(Kind::add, p, q); };
    const Operand trace = sum(sum(entry(0, 0), entry(1, 1)), entry(2, 2));
    const Operand twice_e0 = call("SQRT", {sum(trace, builder_.constant(1.0, at_))});
    if (which == 1) return builder_.binary(Kind::divide, twice_e0, builder_.constant(2.0, at_));
    const auto k = static_cast<std::size_t>(which - 2), i = (k + 1) % 3, j = (k + 2) % 3;
    const Operand difference = builder_.binary(Kind::subtract, entry(j, i), entry(i, j));
    return builder_.binary(Kind::divide, difference,
                           builder_.binary(Kind::multiply, twice_e0, builder_.constant(2.0, at_)));
  }

 private:
  ProgramBuilder& builder_;
  std::array<Operand, 3> axes_;
  Span at_;
};

}  // namespace

Operand ExpressionParser::close_orientation(std::span<const Operand> arguments, const Span& at) {
  const auto system = constant_id(arguments[0], "the number of an orientation system", 1);
  const auto component = constant_id(arguments[1], "the number of a component", 1);
  const auto i = constant_id(arguments[2], "the id of a marker", 0);
  const auto j =
      arguments.size() > 3 ? constant_id(arguments[3], "the id of a marker", 0) : std::optional<std::int32_t>(0);
  if (!system || !component || !i || !j) return builder_.placeholder(at);
  const bool sequence = *system <= static_cast<std::int32_t>(sequences.size());
  if (*system > last_system) {
    diagnostics_.error("argument-range", arguments[0].at,
                       fmt::format("ORIENT has the systems 1 to {}, here is {}", last_system, *system));
    return builder_.placeholder(at);
  }
  if (!sequence && *system != euler_parameters) {
    report_not_built(arguments[0].at, fmt::format("ORIENT with the system {}", *system));
    return builder_.placeholder(at);
  }
  if (const std::int32_t most = sequence ? 3 : 4; *component > most) {
    diagnostics_.error(
        "argument-range", arguments[1].at,
        fmt::format("the system {} of ORIENT has the components 1 to {}, here is {}", *system, most, *component));
    return builder_.placeholder(at);
  }
  Atom markers;
  markers.at = at;
  markers.argument_count = 2;
  markers.argument[0] = *i;
  markers.argument[1] = *j;
  markers.set_argument_at(0, arguments[2].at);
  markers.set_argument_at(1, arguments.back().at);
  const Cosines cosines(builder_, {marker_axis(0, markers), marker_axis(1, markers), marker_axis(2, markers)}, at);
  return sequence ? cosines.angle(sequences[static_cast<std::size_t>(*system - 1)], *component)
                  : cosines.euler_parameter(*component);
}

}  // namespace dynalin

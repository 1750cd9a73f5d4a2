// Finds the node at which a value or a derivative stopped being finite, and says why.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "expression/program.h"
#include "expression/program_partials.h"

namespace dynalin {

namespace {

using Kind = ExpressionNode::Kind;

std::string operator_name(const ExpressionProgram& program, const ExpressionNode& node) {
  switch (node.kind) {
    case Kind::negate:
    case Kind::subtract:
      return "-";
    case Kind::add:
      return "+";
    case Kind::multiply:
      return "*";
    case Kind::divide:
      return "/";
    case Kind::power:
      return "**";
    case Kind::call:
      return std::string(program.function_of(node).name);
    case Kind::spline:
      return "the spline";
    case Kind::routine:
      return "USER";
    case Kind::merge:
    case Kind::branch:
    case Kind::jump:
      return "IF";
    case Kind::constant:
    case Kind::atom:
      break;
  }
  return {};
}

// The operands of a node whose values went into its own value.
template <class T>
std::vector<std::size_t> operands_in_use(const ExpressionProgram& program, const ExpressionNode& node,
                                         const std::vector<T>& value) {
  const auto a = static_cast<std::size_t>(node.a), b = static_cast<std::size_t>(node.b);
  switch (node.kind) {
    case Kind::constant:
    case Kind::atom:
    case Kind::jump:
      return {};
    case Kind::negate:
    case Kind::power:
    case Kind::branch:
      return {a};
    case Kind::add:
    case Kind::subtract:
    case Kind::multiply:
    case Kind::divide:
      return {a, b};
    case Kind::call: {
      std::vector<std::size_t> all;
      for (std::size_t k = b; k < b + a; ++k) {
        all.push_back(static_cast<std::size_t>(program.operands()[k]));
      }
      return all;
    }
    case Kind::routine: {
      std::vector<std::size_t> all;
      for (const std::int32_t k : program.inputs_of(node, value).read) all.push_back(static_cast<std::size_t>(k));
      return all;
    }
    case Kind::spline:
      return {static_cast<std::size_t>(program.operands()[b]), static_cast<std::size_t>(program.operands()[b + 1])};
    case Kind::merge: {
      const double selection = value_of(value[a]);
      if (std::isnan(selection)) return {a};
      return {static_cast<std::size_t>(program.operands()[b + static_cast<std::size_t>(selection)])};
    }
  }
  return {};
}

// The arguments as in "(1, 2.5)", without parentheses if there is but one.
std::string in_words(const std::vector<double>& arguments) {
  std::string list;
  for (const double a : arguments) list += fmt::format("{}{:.6g}", list.empty() ? "" : ", ", a);
  return arguments.size() == 1 ? list : "(" + list + ")";
}

template <class T>
std::vector<double> argument_values(const ExpressionProgram& program, const ExpressionNode& node,
                                    const std::vector<T>& value) {
  std::vector<double> arguments;
  for (const std::size_t k : operands_in_use(program, node, value)) {
    arguments.push_back(value_of(value[k]));
  }
  if (node.kind == Kind::power) arguments.push_back(program.constant_of(node));
  return arguments;
}

// Why a node has no finite value while its operands have.
std::string reason_of_value(const ExpressionProgram& program, const ExpressionNode& node,
                            const std::vector<double>& arguments, const Span& at) {
  std::string reason;
  if (node.kind == Kind::call) {
    const Function& function = program.function_of(node);
    reason = function.domain(arguments);
    if (function.of_vector) {
      return reason.empty() ? fmt::format("the result of {} is too large", at.text())
                            : fmt::format("{} has no value where its vector is zero", at.text());
    }
  }
  if (node.kind == Kind::power) reason = variable_power().domain(arguments);
  if (node.kind == Kind::divide && arguments[1] == 0.0) reason = "division by 0";
  if (!reason.empty()) return reason;
  return fmt::format("the result of {} is too large at {}", operator_name(program, node), in_words(arguments));
}

}  // namespace

template <class T>
UndefinedOperation ExpressionProgram::explain_value(std::size_t i, const std::vector<T>& value) const {
  // From the result down to a node with finite operands.
  for (bool descended = true; descended;) {
    descended = false;
    for (const std::size_t k : operands_in_use(*this, nodes()[i], value)) {
      if (is_finite(value[k])) continue;
      i = k;
      descended = true;
      break;
    }
  }
  const ExpressionNode& node = nodes()[i];
  const bool value_is_finite = std::isfinite(value_of(value[i]));
  const std::string_view what = value_is_finite ? "time derivative" : "value";
  if (node.kind == Kind::atom || node.kind == Kind::constant) {
    const std::string name(node.kind == Kind::atom ? atom(static_cast<std::size_t>(node.a)).function->name
                                                   : place(i).text());
    return {name, place(i), fmt::format("{} has no finite {}", place(i).text(), what)};
  }
  const std::vector<double> arguments = argument_values(*this, node, value);
  const std::string name = operator_name(*this, node);
  if (!value_is_finite && node.kind == Kind::routine)
    return {name, place(i), routines()[static_cast<std::size_t>(node.a)].routine->reason_of_value(arguments)};
  if (!value_is_finite) return {name, place(i), reason_of_value(*this, node, arguments, place(i))};
  if (node.kind == Kind::routine) {
    const Routine& routine = *routines()[static_cast<std::size_t>(node.a)].routine;
    return {name, place(i),
            routine.name() + " gives no derivative in time of its value: an entry ..._derivatives would"};
  }
  if (is_size(node)) return {name, place(i), std::string(place(i).text()) + " has no derivative where it is 0"};
  return {name, place(i), fmt::format("a time derivative of {} is infinite at {}", name, in_words(arguments))};
}

template <class T>
UndefinedOperation ExpressionProgram::explain_partial(std::size_t i, const std::vector<T>& value) const {
  const ExpressionNode& node = nodes()[i];
  bool infinite = true, in_time = true;
  visit_partials(*this, node, value, [&](std::size_t, const auto& partial) {
    const double p = value_of(partial);
    in_time = in_time && std::isfinite(p);
    infinite = infinite && !std::isnan(p);
  });
  const std::string name = operator_name(*this, node);
  if (node.kind == Kind::routine) {
    const Routine& routine = *routines()[static_cast<std::size_t>(node.a)].routine;
    return {name, place(i), routine.reason_of_partials(argument_values(*this, node, value))};
  }
  if (is_size(node)) return {name, place(i), std::string(place(i).text()) + " has no derivative where it is 0"};
  return {name, place(i),
          fmt::format("the {}derivative of {} is {} at {}", in_time ? "second " : "", name,
                      infinite ? "infinite" : "not defined", in_words(argument_values(*this, node, value)))};
}

template <class T>
std::optional<UndefinedOperation> ExpressionProgram::find_undefined(std::span<const T> atom_values,
                                                                    UndefinedSearch search) const {
  ExpressionWorkspace<T> workspace;
  if (!is_finite(evaluate(atom_values, workspace))) {
    return explain_value(nodes().size() - 1, workspace.value);
  }
  if (search == UndefinedSearch::value) return std::nullopt;

  sweep_back(workspace);
  // Each node is an operand of one other, so an adjoint that is not finite leads up to where it
  // arose.
  std::vector<std::size_t> user(nodes().size(), nodes().size());
  for (std::size_t i = 0; i < nodes().size(); ++i) {
    if (!workspace.reached[i]) continue;
    for (const std::size_t k : operands_in_use(*this, nodes()[i], workspace.value)) user[k] = i;
  }
  for (std::size_t i = 0; i < nodes().size(); ++i) {
    if (nodes()[i].kind != Kind::atom || is_finite(workspace.adjoint[i])) continue;
    std::size_t cause = user[i];
    while (!is_finite(workspace.adjoint[cause])) cause = user[cause];
    UndefinedOperation found = explain_partial(cause, workspace.value);
    if (is_zero(workspace.adjoint[cause])) found.reason += ", and its factor of 0 does not vanish faster";
    return found;
  }
  return std::nullopt;
}

template std::optional<UndefinedOperation> ExpressionProgram::find_undefined(std::span<const double>,
                                                                             UndefinedSearch) const;
template std::optional<UndefinedOperation> ExpressionProgram::find_undefined(std::span<const Taylor>,
                                                                             UndefinedSearch) const;

}  // namespace dynalin

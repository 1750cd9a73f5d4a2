#include "expression/program.h"

#include <cassert>
#include <limits>

#include "expression/program_partials.h"

namespace dynalin {

namespace {

using Kind = ExpressionNode::Kind;

// Gathers the arguments of a call and evaluates its formula; S is T or, at rest, double.
template <class S, std::size_t capacity, class T>
S call(const Function& function, std::span<const std::int32_t> operands, const std::vector<T>& value) {
  std::array<S, capacity> arguments;
  for (std::size_t k = 0; k < operands.size(); ++k) {
    if constexpr (std::is_same_v<S, T>) {
      arguments[k] = value[static_cast<std::size_t>(operands[k])];
    } else {
      arguments[k] = value_of(value[static_cast<std::size_t>(operands[k])]);
    }
  }
  return function(std::span<const S>(arguments.data(), operands.size()));
}

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double selected_branch(double condition) {
  if (std::isnan(condition)) return condition;
  return condition < 0.0 ? 0.0 : condition == 0.0 ? 1.0 : 2.0;
}

template <class T>
T ExpressionProgram::value_of_call(const ExpressionNode& node, const std::vector<T>& value) const {
  const std::span list(operands().subspan(static_cast<std::size_t>(node.b), static_cast<std::size_t>(node.a)));
  bool at_rest = true;
  for (const std::int32_t k : list) {
    at_rest = at_rest && is_at_rest(value[static_cast<std::size_t>(k)]);
  }
  if (at_rest) return T(call<double, most_arguments>(function_of(node), list, value));
  if (list.size() <= 8) return call<T, 8>(function_of(node), list, value);
  return call<T, most_arguments>(function_of(node), list, value);
}

template <class T>
T ExpressionProgram::value_of_node(const ExpressionNode& node, std::span<const T> atom_values,
                                   const std::vector<T>& value) const {
  const auto a = static_cast<std::size_t>(node.a), b = static_cast<std::size_t>(node.b);
  switch (node.kind) {
    case Kind::constant:
      return T(constant_of(node));
    case Kind::atom:
      return atom_values[a];
    case Kind::negate:
      return -value[a];
    case Kind::add:
      return value[a] + value[b];
    case Kind::subtract:
      return value[a] - value[b];
    case Kind::multiply:
      return value[a] * value[b];
    case Kind::divide:
      return quotient(value[a], value[b]);
    case Kind::power:
      return power_at(value[a], constant_of(node));
    case Kind::call:
      return value_of_call(node, value);
    case Kind::spline:
      return splines()[a].evaluate(value[static_cast<std::size_t>(operands()[b])],
                                   value[static_cast<std::size_t>(operands()[b + 1])]);
    case Kind::routine:
      return routines()[a].routine->value(inputs_of(node, value), routines()[a].which);
    case Kind::merge: {
      const double selection = value_of(value[a]);
      if (std::isnan(selection)) return T(selection);
      return value[static_cast<std::size_t>(operands()[b + static_cast<std::size_t>(selection)])];
    }
    case Kind::branch:
    case Kind::jump:
      break;
  }
  return T(0.0);
}

template <class T>
T ExpressionProgram::evaluate(std::span<const T> atom_values, ExpressionWorkspace<T>& workspace) const {
  assert(atom_values.size() == atom_count());
  const std::span<const ExpressionNode> all = nodes();
  std::vector<T>& value = workspace.value;
  if (value.size() < all.size()) value.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ExpressionNode& node = all[i];
    // The loop's increment then leads to the first node of a branch, or to the merge.
    if (node.kind == Kind::branch) {
      const double selection = selected_branch(value_of(value[static_cast<std::size_t>(node.a)]));
      value[i] = T(selection);
      i = first_node(node, selection) - 1;
    } else if (node.kind == Kind::jump) {
      i = static_cast<std::size_t>(node.a) - 1;
    } else {
      value[i] = value_of_node(node, atom_values, value);
    }
  }
  return value[all.size() - 1];
}

// Nodes of branches not taken hold old values and are never reached; nor is what stands behind a constant zero or the
// flat side of a function, so that an infinite slope there does not matter. An infinite slope behind a derivative that
// merely is zero here matters unless what vanishes there vanishes fast enough.
template <class T>
void ExpressionProgram::sweep_back(ExpressionWorkspace<T>& workspace) const {
  const std::span<const ExpressionNode> all = nodes();
  const std::size_t count = all.size();
  std::vector<T>& adjoint = workspace.adjoint;
  std::vector<char>& reached = workspace.reached;
  if (adjoint.size() < count) adjoint.resize(count), reached.resize(count);
  for (std::size_t i = 0; i < count; ++i) adjoint[i] = T(0.0), reached[i] = false;
  adjoint[count - 1] = T(1.0), reached[count - 1] = true;
  for (std::size_t i = count; i-- > 0;) {
    if (!reached[i]) continue;
    const bool counts = !is_zero(adjoint[i]);
    bool infinite = false;
    visit_partials(*this, all[i], workspace.value, [&](std::size_t operand, const auto& partial) {
      reached[operand] = true;
      if (counts) {
        adjoint[operand] += adjoint[i] * partial;
      } else {
        infinite = infinite || !std::isfinite(value_of(partial));
      }
    });
    if (!infinite || is_differentiable(workspace)) continue;
    visit_partials(*this, all[i], workspace.value, [&](std::size_t operand, const auto& partial) {
      if (!std::isfinite(value_of(partial))) adjoint[operand] += no_number;
    });
  }
}

template <class T>
void ExpressionProgram::differentiate(std::span<T> partials, ExpressionWorkspace<T>& workspace) const {
  assert(partials.size() == atom_count());
  sweep_back(workspace);
  for (T& partial : partials) partial = T(0.0);
  const std::span<const ExpressionNode> all = nodes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].kind != Kind::atom) continue;
    partials[static_cast<std::size_t>(all[i].a)] += workspace.adjoint[i];
  }
}

template double ExpressionProgram::value_of_node(const ExpressionNode&, std::span<const double>,
                                                 const std::vector<double>&) const;
template double ExpressionProgram::evaluate(std::span<const double>, ExpressionWorkspace<double>&) const;
template Taylor ExpressionProgram::evaluate(std::span<const Taylor>, ExpressionWorkspace<Taylor>&) const;
template void ExpressionProgram::differentiate(std::span<double>, ExpressionWorkspace<double>&) const;
template void ExpressionProgram::differentiate(std::span<Taylor>, ExpressionWorkspace<Taylor>&) const;
template void ExpressionProgram::sweep_back(ExpressionWorkspace<double>&) const;
template void ExpressionProgram::sweep_back(ExpressionWorkspace<Taylor>&) const;

}  // namespace dynalin

// Where an expression has kinks and jumps: what changes its sign there.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "expression/program.h"
#include "expression/program_partials.h"

namespace dynalin {

namespace {

using Kind = ExpressionNode::Kind;

// A SENSOR that stores another value makes the integration begin anew by itself.
bool stands_still(const Atom& atom) { return dynalin::stands_still(atom.function->reads); }

}  // namespace

// A condition that is constant between jumps, such as one made of IFs with constant branches, adds nothing to what
// makes it jump.
std::vector<std::int32_t> switching_nodes(const ProgramDraft& draft) {
  const auto may_switch = [](const DraftNode& node) {
    return node.kind == Kind::branch || node.kind == Kind::spline ||
           (node.kind == Kind::call && node.function->switches);
  };
  if (std::ranges::none_of(draft.nodes, may_switch)) return {};
  std::vector<char> in_steps(draft.nodes.size());
  std::vector<std::int32_t> switching;
  for (std::size_t i = 0; i < draft.nodes.size(); ++i) {
    const DraftNode& node = draft.nodes[i];
    const auto a = static_cast<std::size_t>(node.a), b = static_cast<std::size_t>(node.b);
    const auto all_in_steps = [&](std::size_t count) {
      for (std::size_t k = b; k < b + count; ++k)
        if (!in_steps[static_cast<std::size_t>(draft.operands[k])]) return false;
      return true;
    };
    bool switches = false;
    switch (node.kind) {
      case Kind::constant:
      case Kind::jump:
        in_steps[i] = true;
        break;
      case Kind::atom:
        in_steps[i] = stands_still(draft.atoms[a]);
        break;
      case Kind::negate:
      case Kind::power:
        in_steps[i] = in_steps[a];
        break;
      case Kind::add:
      case Kind::subtract:
      case Kind::multiply:
      case Kind::divide:
        in_steps[i] = in_steps[a] && in_steps[b];
        break;
      case Kind::call:
        in_steps[i] = all_in_steps(a);
        switches = node.function->switches && !in_steps[i];
        break;
      case Kind::spline:
        in_steps[i] = all_in_steps(2);
        switches = !in_steps[i];
        break;
      case Kind::routine:  // its kinks are its own
        break;
      case Kind::branch:
        in_steps[i] = true;
        switches = !in_steps[a];
        break;
      case Kind::merge:
        in_steps[i] = all_in_steps(3);
        break;
    }
    if (switches) switching.push_back(static_cast<std::int32_t>(i));
  }
  return switching;
}

void ExpressionProgram::add_switches(const ExpressionNode& node, const std::vector<double>& value, bool taken,
                                     SwitchList& out) const {
  const auto a = static_cast<std::size_t>(node.a), b = static_cast<std::size_t>(node.b);
  const auto operand = [&](std::size_t k) { return value[static_cast<std::size_t>(operands()[b + k])]; };
  const std::size_t first = out.counts.size();
  if (node.kind == Kind::branch) {
    out.add(value[a]);
  } else if (node.kind == Kind::spline) {
    splines()[a].switches(operand(0), operand(1), out);
  } else {
    std::array<double, most_arguments> arguments;
    for (std::size_t k = 0; k < a; ++k) arguments[k] = operand(k);
    function_of(node).switches(std::span<const double>(arguments.data(), a), out);
  }
  if (taken) return;
  for (std::size_t k = first; k < out.counts.size(); ++k) out.counts[k] = false;
}

template <class Visit>
void ExpressionProgram::sweep_switching(std::span<const double> atom_values, std::vector<double>& value,
                                        const Visit& visit) const {
  assert(atom_values.size() == atom_count());
  const std::span<const ExpressionNode> all = nodes();
  if (value.size() < all.size()) value.resize(all.size());
  std::size_t taken = 0;  // the next node that an evaluation would visit
  auto next = switching().begin();
  for (std::size_t i = 0; i < all.size() && next != switching().end(); ++i) {
    const ExpressionNode& node = all[i];
    const bool visited = i == taken;
    if (visited) taken = i + 1;
    if (node.kind == Kind::branch) {
      value[i] = selected_branch(value[static_cast<std::size_t>(node.a)]);
      if (visited) taken = first_node(node, value[i]);
    } else if (node.kind == Kind::jump) {
      if (visited) taken = static_cast<std::size_t>(node.a);
    } else {
      value[i] = value_of_node<double>(node, atom_values, value);
    }
    if (static_cast<std::size_t>(*next) != i) continue;
    visit(node, visited);
    ++next;
  }
}

void ExpressionProgram::switches(std::span<const double> atom_values, ExpressionWorkspace<double>& workspace,
                                 SwitchList& out) const {
  sweep_switching(atom_values, workspace.value,
                  [&](const ExpressionNode& node, bool taken) { add_switches(node, workspace.value, taken, out); });
}

void ExpressionProgram::look_ahead(std::span<const double> from, std::span<const double> to,
                                   ExpressionWorkspace<double>& workspace, StepReach& reach) const {
  struct Place {
    double x, z;
    bool taken;
  };
  std::vector<Place> begins;
  const auto place = [&](const ExpressionNode& node, bool taken) {
    const auto argument = [&](std::size_t k) {
      return workspace.value[static_cast<std::size_t>(operands()[static_cast<std::size_t>(node.b) + k])];
    };
    return Place{argument(0), argument(1), taken};
  };
  sweep_switching(from, workspace.value, [&](const ExpressionNode& node, bool taken) {
    if (node.kind == Kind::spline) begins.push_back(place(node, taken));
  });
  auto begin = begins.begin();
  sweep_switching(to, workspace.value, [&](const ExpressionNode& node, bool taken) {
    if (node.kind != Kind::spline) return;
    const Place a = *begin++, b = place(node, taken);
    if (a.taken || b.taken) splines()[static_cast<std::size_t>(node.a)].look_ahead(a.x, a.z, b.x, b.z, reach);
  });
}

}  // namespace dynalin

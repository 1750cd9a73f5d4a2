#include "expression/program_builder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "expression/program.h"

namespace dynalin {

namespace {

using Kind = ExpressionNode::Kind;

bool is_nan(double x) { return std::isnan(x); }

double value_of_constants(const DraftNode& node, std::span<const double> a) {
  switch (node.kind) {
    case Kind::negate:
      return -a[0];
    case Kind::add:
      return a[0] + a[1];
    case Kind::subtract:
      return a[0] - a[1];
    case Kind::multiply:
      return a[0] * a[1];
    case Kind::divide:
      return a[0] / a[1];
    case Kind::power:
      return std::pow(a[0], node.constant);
    case Kind::call:
      return (*node.function)(a);
    default:
      assert(false && "no other node is folded");
      return std::numeric_limits<double>::quiet_NaN();
  }
}

std::string reason_for_no_value(const DraftNode& node, std::span<const double> a) {
  std::string reason;
  if (node.kind == Kind::call) reason = node.function->domain(a);
  if (node.kind == Kind::power) reason = variable_power().domain(std::array{a[0], node.constant});
  if (node.kind == Kind::divide && a[1] == 0.0) reason = "division by 0";
  return reason.empty() ? "the result is too large" : reason;
}

}  // namespace

ProgramBuilder::ProgramBuilder(Diagnostics& diagnostics, ProgramShapes& shapes, std::size_t words)
    : diagnostics_(diagnostics), shapes_(shapes), program_(shapes.take_draft()) {
  constexpr std::size_t some = 4;
  program_.nodes.reserve(words);
  program_.places.reserve(words);
  program_.atoms.reserve(some);
}

ProgramBuilder::~ProgramBuilder() { shapes_.give_back(std::move(program_)); }

std::int32_t ProgramBuilder::push(const DraftNode& node, const Span& at) {
  program_.add(node, at);
  return next() - 1;
}

void ProgramBuilder::pop(std::size_t count) {
  program_.nodes.resize(program_.nodes.size() - count);
  program_.places.resize(program_.nodes.size());
}

std::int32_t ProgramBuilder::push_operands(std::span<const std::int32_t> nodes) {
  const auto first = static_cast<std::int32_t>(program_.operands.size());
  program_.operands.insert(program_.operands.end(), nodes.begin(), nodes.end());
  return first;
}

std::optional<double> ProgramBuilder::constant_value(const Operand& operand) const {
  const DraftNode& node = program_.nodes[static_cast<std::size_t>(operand.node)];
  return node.kind == Kind::constant ? std::optional(node.constant) : std::nullopt;
}

void ProgramBuilder::report_domain(std::string reason, const Span& at) {
  diagnostics_.error("function-domain", at, "this has no finite value: " + std::move(reason));
}

Operand ProgramBuilder::constant(double value, const Span& at) {
  return {push({.kind = Kind::constant, .constant = value}, at), at};
}

Operand ProgramBuilder::placeholder(const Span& at) {
  Operand nothing = constant(std::numeric_limits<double>::quiet_NaN(), at);
  nothing.unknown = true;
  return nothing;
}

// The place of an atom among those of the program, to which it is added if it is new.
std::int32_t ProgramBuilder::index_of(const Atom& atom) {
  // An argument left out means 0, so DX(1) and DX(1,0) are the same.
  const auto is_same = [&](const Atom& other) {
    return other.function == atom.function && other.argument == atom.argument && other.delayed == atom.delayed;
  };
  const auto hash = [](const Atom& a) {
    std::size_t key = std::hash<const void*>{}(a.function) ^ std::hash<const void*>{}(a.delayed.get());
    for (const std::int32_t id : a.argument) key = 31 * key + static_cast<std::size_t>(id);
    return key;
  };
  std::vector<Atom>& atoms = program_.atoms;
  const auto number = [&](auto iterator) { return static_cast<std::int32_t>(iterator - atoms.begin()); };
  // Sums over all parts of a model have as many atoms.
  constexpr std::size_t few = 16;
  if (atoms.size() <= few) {
    const auto found = std::ranges::find_if(atoms, is_same);
    if (found != atoms.end()) return number(found);
  } else {
    const auto [first, last] = atom_index_.equal_range(hash(atom));
    const auto found = std::find_if(
        first, last, [&](const auto& entry) { return is_same(atoms[static_cast<std::size_t>(entry.second)]); });
    if (found != last) return found->second;
  }
  atoms.push_back(atom);
  if (atoms.size() == few + 1) {
    for (auto a = atoms.begin(); a != atoms.end(); ++a) atom_index_.emplace(hash(*a), number(a));
  } else if (atoms.size() > few) {
    atom_index_.emplace(hash(atom), number(atoms.end() - 1));
  }
  return number(atoms.end() - 1);
}

Operand ProgramBuilder::atom(const Atom& atom) {
  return {push({.kind = Kind::atom, .a = index_of(atom)}, atom.at), atom.at};
}

// Inside of an IF a constant without finite value is left for the run, which may never select its
// branch.
Operand ProgramBuilder::fold(const DraftNode& node, std::span<const Operand> operands, const Span& at) {
  std::vector<double> values;
  values.reserve(operands.size());
  for (const Operand& operand : operands) values.push_back(*constant_value(operand));
  const double value = value_of_constants(node, values);
  // Operands that stand last are used by nobody else; components of a vector may be.
  const auto first = next() - static_cast<std::int32_t>(operands.size());
  bool last = first >= 0;
  for (std::size_t k = 0; k < operands.size(); ++k)
    last = last && operands[k].node == first + static_cast<std::int32_t>(k);
  if (!std::isfinite(value) && std::ranges::none_of(values, is_nan)) {
    if (branch_depth_ > 0) return {push(node, at), at};
    report_domain(reason_for_no_value(node, values), at);
    if (last) pop(operands.size());
    return placeholder(at);
  }
  if (last) pop(operands.size());
  return constant(value, at);
}

Operand ProgramBuilder::negate(const Operand& a, const Span& at) {
  const DraftNode node{.kind = Kind::negate, .a = a.node};
  if (constant_value(a)) return fold(node, {&a, 1}, at);
  return {push(node, at), at};
}

Operand ProgramBuilder::binary(Kind kind, const Operand& a, const Operand& b) {
  const Span at = join(a.at, b.at);
  const DraftNode node{.kind = kind, .a = a.node, .b = b.node};
  const auto divisor = constant_value(b);
  if (constant_value(a) && divisor) return fold(node, std::array{a, b}, at);
  if (kind == Kind::divide && divisor == 0.0 && branch_depth_ == 0) {
    report_domain("division by 0", at);
  }
  return {push(node, at), at};
}

Operand ProgramBuilder::power(const Operand& base, const Operand& exponent) {
  const Span at = join(base.at, exponent.at);
  const auto n = constant_value(exponent);
  if (!n) return call(variable_power(), std::array{base, exponent}, at);
  // The exponent is the last node; it moves into the power itself.
  pop(1);
  const DraftNode node{.kind = Kind::power, .a = base.node, .constant = *n};
  if (constant_value(base)) return fold(node, {&base, 1}, at);
  return {push(node, at), at};
}

Operand ProgramBuilder::call(const Function& function, std::span<const Operand> arguments, const Span& at) {
  std::vector<std::int32_t> list;
  std::vector<double> known;
  list.reserve(arguments.size());
  known.reserve(arguments.size());
  bool all_constant = true;
  for (const Operand& argument : arguments) {
    const auto value = constant_value(argument);
    all_constant = all_constant && value;
    known.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    list.push_back(argument.node);
  }
  if (!all_constant) {
    std::string reason = function.domain(known);
    if (!reason.empty()) report_domain(std::move(reason), at);
  }
  const DraftNode node{
      .kind = Kind::call, .a = static_cast<std::int32_t>(list.size()), .b = push_operands(list), .function = &function};
  return all_constant ? fold(node, arguments, at) : Operand{push(node, at), at};
}

Operand ProgramBuilder::spline(SplineUse use, const Operand& x, const Operand& z) {
  const Span at = use.at;
  program_.splines.push_back(std::move(use));
  const DraftNode node{.kind = Kind::spline,
                       .a = static_cast<std::int32_t>(program_.splines.size()) - 1,
                       .b = push_operands(std::array{x.node, z.node})};
  return {push(node, at), at};
}

OpenIf ProgramBuilder::open_if(const Operand& condition) {
  OpenIf open;
  open.condition = condition;
  ++branch_depth_;
  const auto value = constant_value(condition);
  if (value && !std::isnan(*value)) {
    pop(1);
    open.selected = *value < 0.0 ? 0 : *value == 0.0 ? 1 : 2;
    return open;
  }
  open.table = push_operands(std::array<std::int32_t, 4>{});
  open.branch = push({.kind = Kind::branch, .a = condition.node, .b = open.table}, condition.at);
  return open;
}

void ProgramBuilder::begin_branch(OpenIf& open) {
  open.mark = program_.nodes.size();
  if (!open.selected) {
    program_.operands[static_cast<std::size_t>(open.table) + open.branches_begun] = next();
  }
  ++open.branches_begun;
}

void ProgramBuilder::end_branch(OpenIf& open, const Operand& result) {
  const std::size_t index = open.branches_begun - 1;
  open.results[index] = result.node;
  if (open.selected) {
    if (*open.selected != index) pop(program_.nodes.size() - open.mark);
  } else if (index < 2) {
    open.jumps[index] = push({.kind = Kind::jump}, result.at);
  }
}

Operand ProgramBuilder::close_if(const OpenIf& open, const Span& at) {
  assert(open.branches_begun == 3);
  --branch_depth_;
  if (open.selected) return {open.results[*open.selected], at};
  const std::int32_t merge = push({.kind = Kind::merge, .a = open.branch, .b = push_operands(open.results)}, at);
  program_.operands[static_cast<std::size_t>(open.table) + 3] = merge;
  for (const std::int32_t jump : open.jumps) {
    program_.nodes[static_cast<std::size_t>(jump)].a = merge;
  }
  return {merge, at};
}

// Atoms of branches that a constant condition ruled out are gone.
void ProgramBuilder::drop_unused_atoms() {
  std::int32_t in_order = 0;
  for (const DraftNode& node : program_.nodes) {
    if (node.kind == Kind::atom && node.a == in_order) ++in_order;
  }
  if (static_cast<std::size_t>(in_order) == program_.atoms.size()) return;  // as in most expressions
  constexpr std::int32_t unused = -1;
  std::vector<std::int32_t> new_index(program_.atoms.size(), unused);
  std::vector<Atom> kept;
  kept.reserve(program_.atoms.size());
  for (DraftNode& node : program_.nodes) {
    if (node.kind != Kind::atom) continue;
    std::int32_t& index = new_index[static_cast<std::size_t>(node.a)];
    if (index == unused) {
      index = static_cast<std::int32_t>(kept.size());
      kept.push_back(std::move(program_.atoms[static_cast<std::size_t>(node.a)]));
    }
    node.a = index;
  }
  program_.atoms = std::move(kept);
}

std::shared_ptr<const ExpressionProgram> ProgramBuilder::finish(const Span& at) {
  program_.at = at;
  join_angles();
  drop_unused_atoms();
  return std::make_shared<const ExpressionProgram>(program_, shapes_);
}

}  // namespace dynalin

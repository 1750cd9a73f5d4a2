// Puts expressions in the place of atoms.
#include <utility>

#include "expression/program.h"

namespace dynalin {

namespace {

using Kind = ExpressionNode::Kind;

// Where a node went. A node that gave way to a definition is nowhere itself: what comes behind it is entered instead.
struct Place {
  std::int32_t entry = -1, value = -1;
};

class Substitution {
 public:
  explicit Substitution(ProgramDraft& out) : out_(out) {}

  // Copies `program` behind what is there and returns the node of its result; `defined` holds the nodes whose values
  // take the place of its atoms, −1 for those that stay.
  std::int32_t append(const ProgramDraft& program, const std::vector<std::int32_t>& defined) {
    std::vector<Place> places(program.nodes.size());
    for (std::size_t k = 0; k < program.nodes.size(); ++k) {
      const DraftNode& node = program.nodes[k];
      const bool given = node.kind == Kind::atom && !defined.empty() && defined[static_cast<std::size_t>(node.a)] >= 0;
      places[k] = {next(), given ? defined[static_cast<std::size_t>(node.a)] : next()};
      if (given) continue;
      out_.add(node, program.places[k]);
    }
    for (std::size_t k = 0; k < program.nodes.size(); ++k) {
      if (places[k].entry == places[k].value) renumber(program, places, k);
    }
    return places.back().value;
  }

  // The result of a program is its last node.
  void finish(std::int32_t result, const Span& at) {
    if (result + 1 == next()) return;
    DraftNode zero, sum;
    zero.kind = Kind::constant;
    sum.kind = Kind::add, sum.a = result, sum.b = next();
    out_.add(zero, at);
    out_.add(sum, at);
  }

 private:
  std::int32_t next() const { return static_cast<std::int32_t>(out_.nodes.size()); }

  void renumber(const ProgramDraft& program, const std::vector<Place>& places, std::size_t k) {
    DraftNode& node = out_.nodes[static_cast<std::size_t>(places[k].value)];
    const auto value = [&](std::int32_t old) { return places[static_cast<std::size_t>(old)].value; };
    const auto entry = [&](std::int32_t old) { return places[static_cast<std::size_t>(old)].entry; };
    const auto move_operands = [&](std::int32_t count, bool entries) {
      const auto first = static_cast<std::int32_t>(out_.operands.size());
      for (std::int32_t i = 0; i < count; ++i) {
        const std::int32_t old = program.operands[static_cast<std::size_t>(node.b + i)];
        out_.operands.push_back(entries ? entry(old) : value(old));
      }
      node.b = first;
    };
    switch (node.kind) {
      case Kind::constant:
        break;
      case Kind::atom:
        node.a = atom(program.atoms[static_cast<std::size_t>(node.a)]);
        break;
      case Kind::negate:
      case Kind::power:
        node.a = value(node.a);
        break;
      case Kind::add:
      case Kind::subtract:
      case Kind::multiply:
      case Kind::divide:
        node.a = value(node.a), node.b = value(node.b);
        break;
      case Kind::call:
        move_operands(node.a, false);
        break;
      case Kind::spline:
        out_.splines.push_back(program.splines[static_cast<std::size_t>(node.a)]);
        node.a = static_cast<std::int32_t>(out_.splines.size()) - 1;
        move_operands(2, false);
        break;
      case Kind::routine: {
        const RoutineUse& use = program.routines[static_cast<std::size_t>(node.a)];
        move_operands(static_cast<std::int32_t>(use.inputs), false);
        out_.routines.push_back(use);
        node.a = static_cast<std::int32_t>(out_.routines.size()) - 1;
        break;
      }
      case Kind::branch:
        node.a = value(node.a);
        move_operands(4, true);
        break;
      case Kind::jump:
        node.a = entry(node.a);
        break;
      case Kind::merge:
        node.a = value(node.a);
        move_operands(3, false);
        break;
    }
  }

  std::int32_t atom(const Atom& wanted) {
    for (std::size_t k = 0; k < out_.atoms.size(); ++k) {
      const Atom& a = out_.atoms[k];
      if (a.function == wanted.function && a.argument == wanted.argument && a.delayed == wanted.delayed)
        return static_cast<std::int32_t>(k);
    }
    out_.atoms.push_back(wanted);
    return static_cast<std::int32_t>(out_.atoms.size()) - 1;
  }

  ProgramDraft& out_;
};

}  // namespace

// Each definition stands once, in front of all that reads it.
Expression Expression::with_definitions(const std::function<std::optional<Expression>(const Atom&)>& define) const {
  const ProgramDraft own = program_->draft();
  ProgramDraft draft;
  draft.at = own.at;
  Substitution out(draft);
  std::vector<std::int32_t> defined;
  bool any = false;
  for (const Atom& a : own.atoms) {
    const auto e = define(a);
    defined.push_back(e ? out.append(e->program_->draft(), {}) : -1);
    any = any || e;
  }
  if (!any) return *this;
  out.finish(out.append(own, defined), own.at);
  ProgramShapes alone;
  return Expression(std::make_shared<const ExpressionProgram>(draft, alone));
}

}  // namespace dynalin

#include "expression/expression.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "expression/parser.h"
#include "expression/program.h"

namespace dynalin {

namespace {

// Of an expression that is made and not read.
std::shared_ptr<const ExpressionProgram> program_of(const ProgramDraft& draft) {
  ProgramShapes alone;
  return std::make_shared<const ExpressionProgram>(draft, alone);
}

std::shared_ptr<const ExpressionProgram> constant_program(double value) {
  ProgramDraft draft;
  draft.add({.constant = value}, {});
  return program_of(draft);
}

}  // namespace

// Every argument that may be an expression begins as this one.
Expression::Expression() {
  static const std::shared_ptr<const ExpressionProgram> zero = constant_program(0.0);
  program_ = zero;
}
Expression::Expression(std::shared_ptr<const ExpressionProgram> program) : program_(std::move(program)) {}

Expression Expression::constant(double value) { return Expression(constant_program(value)); }

Expression Expression::of_atom(const Atom& atom) {
  ProgramDraft draft;
  draft.at = atom.at;
  draft.atoms.push_back(atom);
  draft.add({.kind = ExpressionNode::Kind::atom}, atom.at);
  return Expression(program_of(draft));
}

Expression ExpressionParser::of_routine(std::vector<Atom> inputs, std::shared_ptr<const Routine> routine,
                                        std::size_t which, const Span& at) {
  ProgramDraft draft;
  draft.at = at;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const auto number = static_cast<std::int32_t>(k);
    draft.add({.kind = ExpressionNode::Kind::atom, .a = number}, at);
    draft.operands.push_back(number);
  }
  draft.routines.push_back({std::move(routine), which, inputs.size(), at});
  draft.add({.kind = ExpressionNode::Kind::routine}, at);
  draft.atoms = std::move(inputs);
  return Expression(program_of(draft));
}

Expression routine_expression(std::vector<Atom> inputs, std::shared_ptr<const Routine> routine, std::size_t which,
                              const Span& at) {
  return ExpressionParser::of_routine(std::move(inputs), std::move(routine), which, at);
}

Atom AtomList::Iterator::operator*() const { return program_->atom(number_); }

AtomList Expression::atoms() const { return {*program_, program_->atom_count()}; }
Span Expression::at() const { return program_->at(); }

std::span<const SplineUse> Expression::splines() const { return program_->splines(); }

Expression Expression::with_curves(const std::function<void(SplineUse&)>& attach) const {
  if (splines().empty()) return *this;
  std::vector<SplineUse> attached(splines().begin(), splines().end());
  for (SplineUse& use : attached) attach(use);
  return Expression(std::make_shared<const ExpressionProgram>(*program_, std::move(attached)));
}

bool Expression::has_switches() const { return !program_->switching().empty(); }

void Expression::switches(std::span<const double> atom_values, ExpressionWorkspace<double>& workspace,
                          SwitchList& out) const {
  if (has_switches()) program_->switches(atom_values, workspace, out);
}

void Expression::look_ahead(std::span<const double> from, std::span<const double> to,
                            ExpressionWorkspace<double>& workspace, StepReach& reach) const {
  if (has_tables()) program_->look_ahead(from, to, workspace, reach);
}

std::vector<Expression::Call> Expression::calls() const {
  std::vector<Call> calls;
  for (std::size_t k = 0; k < program_->nodes().size(); ++k) {
    const ExpressionNode& node = program_->nodes()[k];
    // The merge has the place of the whole, the branch that of its condition.
    if (node.kind == ExpressionNode::Kind::merge) calls.push_back({"IF", program_->place(k)});
    if (node.kind == ExpressionNode::Kind::call)
      calls.push_back({program_->function_of(node).name, program_->place(k)});
  }
  return calls;
}

template <class T>
T Expression::evaluate(std::span<const T> atom_values, ExpressionWorkspace<T>& workspace) const {
  return program_->evaluate(atom_values, workspace);
}

template <class T>
T Expression::evaluate(std::span<const T> atom_values, std::span<T> partials, ExpressionWorkspace<T>& workspace) const {
  const T value = program_->evaluate(atom_values, workspace);
  program_->differentiate(partials, workspace);
  return value;
}

template <class T>
bool Expression::reaches(std::size_t atom, const ExpressionWorkspace<T>& workspace) const {
  const auto nodes = program_->nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].kind != ExpressionNode::Kind::atom || static_cast<std::size_t>(nodes[i].a) != atom) continue;
    if (workspace.reached[i]) return true;
  }
  return false;
}
template bool Expression::reaches(std::size_t, const ExpressionWorkspace<double>&) const;
template bool Expression::reaches(std::size_t, const ExpressionWorkspace<TimeTaylor<double>>&) const;

std::optional<Span> Expression::size_of_nothing(ExpressionWorkspace<double>& workspace) const {
  return program_->size_of_nothing(workspace);
}

template <class T>
std::optional<UndefinedOperation> Expression::find_undefined(std::span<const T> atom_values,
                                                             UndefinedSearch search) const {
  return program_->find_undefined(atom_values, search);
}

template double Expression::evaluate(std::span<const double>, ExpressionWorkspace<double>&) const;
template double Expression::evaluate(std::span<const double>, std::span<double>, ExpressionWorkspace<double>&) const;
template std::optional<UndefinedOperation> Expression::find_undefined(std::span<const double>, UndefinedSearch) const;
template TimeTaylor<double> Expression::evaluate(std::span<const TimeTaylor<double>>,
                                                 ExpressionWorkspace<TimeTaylor<double>>&) const;
template TimeTaylor<double> Expression::evaluate(std::span<const TimeTaylor<double>>, std::span<TimeTaylor<double>>,
                                                 ExpressionWorkspace<TimeTaylor<double>>&) const;
template std::optional<UndefinedOperation> Expression::find_undefined(std::span<const TimeTaylor<double>>,
                                                                      UndefinedSearch) const;

}  // namespace dynalin

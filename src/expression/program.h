// The flat program of an expression in post order, every operand before what uses it: a tree, but for components of
// vectors, which several nodes may use.
//
// The forward sweep computes the value of each node. The reverse sweep carries the derivative of
// the result with respect to each node, its adjoint, from the result down to the atoms. The three
// branches of an IF stand one after the other behind the condition, with jumps around those not
// selected:
//
//     condition  branch  e2 …  jump  e3 …  jump  e4 …  merge
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "expression/expression.h"
#include "expression/functions.h"
#include "expression/program_draft.h"
#include "expression/program_shapes.h"
#include "expression/routine.h"
#include "expression/spline.h"

namespace dynalin {

// Which branch of an IF a condition selects: 0, 1, 2 for negative, zero, positive; NaN selects none.
double selected_branch(double condition);

class ExpressionProgram {
 public:
  ExpressionProgram(const ProgramDraft&, ProgramShapes&);
  // The same with other splines.
  ExpressionProgram(const ExpressionProgram&, std::vector<SplineUse>);

  std::span<const ExpressionNode> nodes() const { return shape_->nodes; }  // the last one is the result
  std::span<const std::int32_t> operands() const { return shape_->operands; }
  std::span<const std::int32_t> switching() const { return shape_->switching; }
  const Function& function_of(const ExpressionNode& call) const { return *shape_->functions[call.function]; }
  bool is_size(const ExpressionNode& node) const {
    return node.kind == ExpressionNode::Kind::call && function_of(node).is_size;
  }
  double constant_of(const ExpressionNode& node) const { return numbers_[static_cast<std::size_t>(node.b)]; }
  Span place(std::size_t node) const;
  std::size_t atom_count() const { return has_whole_atoms() ? more_->atoms.size() : shape_->atoms.size(); }
  Atom atom(std::size_t number) const;
  std::span<const SplineUse> splines() const;  // evaluate to NaN until their curves are attached
  std::span<const RoutineUse> routines() const;
  Span at() const { return {shape_->source, offset_, shape_->length}; }
  // To make another one of it.
  ProgramDraft draft() const;

  // One sweep over all nodes, those of branches not taken included: as many switches whichever are.
  void switches(std::span<const double> atom_values, ExpressionWorkspace<double>&, SwitchList&) const;
  // What tables have between the ends of a step.
  void look_ahead(std::span<const double> from, std::span<const double> to, ExpressionWorkspace<double>&,
                  StepReach&) const;

  // Forward sweep; afterwards the workspace holds the value of each node visited.
  template <class T>
  T evaluate(std::span<const T> atom_values, ExpressionWorkspace<T>&) const;
  // Reverse sweep after a forward sweep.
  template <class T>
  void differentiate(std::span<T> partials, ExpressionWorkspace<T>&) const;
  template <class T>
  std::optional<UndefinedOperation> find_undefined(std::span<const T> atom_values, UndefinedSearch) const;
  // After a reverse sweep: a size that is zero, matters to the result and grows whichever way its vector goes.
  std::optional<Span> size_of_nothing(ExpressionWorkspace<double>&) const;

  // What a node of a routine reads.
  template <class T>
  RoutineInputs<T> inputs_of(const ExpressionNode& node, const std::vector<T>& value) const {
    const std::size_t count = routines()[static_cast<std::size_t>(node.a)].inputs;
    return {value, operands().subspan(static_cast<std::size_t>(node.b), count)};
  }

 private:
  template <class T>
  T value_of_call(const ExpressionNode&, const std::vector<T>& value) const;
  // Of any node but branch and jump.
  template <class T>
  T value_of_node(const ExpressionNode&, std::span<const T> atom_values, const std::vector<T>& value) const;
  // Where a branch goes on.
  std::size_t first_node(const ExpressionNode& branch, double selection) const {
    const std::size_t entry = selection >= 0 ? static_cast<std::size_t>(selection) : 3;
    return static_cast<std::size_t>(operands()[static_cast<std::size_t>(branch.b) + entry]);
  }
  // A sweep over all nodes as far as the last of switching(), each of which is visited with its number and whether an
  // evaluation would come there.
  template <class Visit>
  void sweep_switching(std::span<const double> atom_values, std::vector<double>& value, const Visit&) const;
  void add_switches(const ExpressionNode&, const std::vector<double>& value, bool taken, SwitchList&) const;
  // Whether the chain rule holds for the result although a node has an infinite derivative (vanishing.cpp).
  template <class T>
  bool is_differentiable(ExpressionWorkspace<T>&) const;
  // Leaves the adjoint of each node in the workspace.
  template <class T>
  void sweep_back(ExpressionWorkspace<T>&) const;
  template <class T>
  UndefinedOperation explain_value(std::size_t node, const std::vector<T>& value) const;
  template <class T>
  UndefinedOperation explain_partial(std::size_t node, const std::vector<T>& value) const;

  // What few expressions have.
  struct More {
    std::vector<SplineUse> splines;
    std::vector<RoutineUse> routines;
    std::vector<Atom> atoms;   // all of them, where the shape cannot tell one: of DELAY, or in another text
    std::vector<Span> places;  // of all nodes, where one is in another text
  };
  bool has_whole_atoms() const { return more_ && !more_->atoms.empty(); }
  // Of all atoms, one after the other.
  std::int32_t argument(std::size_t number) const;
  // As many as `numbers_` has, which are these constants and arguments.
  static std::size_t count_of_numbers(std::size_t constants, std::size_t arguments) {
    return constants + (arguments + 1) / 2;
  }

  // Large models have a great many: with the counters in front of it, it just fills the 56 bytes that a block of 64
  // holds.
  std::shared_ptr<const ProgramShape> shape_;
  // Constants of nodes, and behind them arguments of atoms, two in the place of one number.
  std::unique_ptr<double[]> numbers_;
  std::unique_ptr<const More> more_;
  std::uint32_t offset_;  // where it begins in the source
};

}  // namespace dynalin

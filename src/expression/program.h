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
#include <optional>
#include <span>
#include <vector>

#include "expression/expression.h"
#include "expression/functions.h"
#include "expression/routine.h"
#include "expression/spline.h"

namespace dynalin {

struct ExpressionNode {
  enum class Kind : std::uint8_t {
    constant,  // constant
    atom,      // atom number a
    negate,    // −a
    add,       // a + b
    subtract,  // a − b
    multiply,  // a b
    divide,    // a / b
    power,     // a ** constant
    call,      // function of operands[b] … operands[b + a − 1]
    spline,    // spline number a at x = operands[b], z = operands[b + 1]
    routine,   // routine number a, reads routines[a].inputs nodes from operands[b] on
    branch,    // looks at node a; operands[b …]: first node of each of three branches, then the merge
    jump,      // to node a
    merge,     // of branch a; operands[b …]: result node of each of three branches
  };
  Kind kind = Kind::constant;
  std::int32_t a = 0, b = 0;
  const Function* function = nullptr;
  double constant = 0;
};

// Which branch of an IF a condition selects: 0, 1, 2 for negative, zero, positive; NaN selects none.
double selected_branch(double condition);

class ExpressionProgram {
 public:
  std::vector<ExpressionNode> nodes;  // the last one is the result
  std::vector<std::int32_t> operands;
  std::vector<Span> places;  // of each node
  std::vector<Atom> atoms;
  std::vector<SplineUse> splines;  // evaluate to NaN until their curves are attached
  std::vector<RoutineUse> routines;
  std::vector<std::int32_t> switching;  // nodes with kinks or jumps that depend on the motion
  Span at;

  // Fills `switching`, when all nodes are there.
  void find_switching();
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
    const std::size_t count = routines[static_cast<std::size_t>(node.a)].inputs;
    return {value, std::span(operands).subspan(static_cast<std::size_t>(node.b), count)};
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
    return static_cast<std::size_t>(operands[static_cast<std::size_t>(branch.b) + entry]);
  }
  // A sweep over all nodes as far as the last of `switching`, each of which is visited with its number and whether an
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
};

}  // namespace dynalin

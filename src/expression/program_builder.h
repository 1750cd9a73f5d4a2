// Builds the flat program of an expression from its parts in post order, and folds constants on the
// way.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "base/diagnostics.h"
#include "expression/program.h"

namespace dynalin {

// The result of a part of an expression: its node, and where the part stands.
struct Operand {
  std::int32_t node = -1;
  Span at;
};

// An IF between its condition and its closing parenthesis.
struct OpenIf {
  Operand condition;
  std::optional<std::size_t> selected;  // of a constant condition; the other branches vanish
  std::int32_t branch = -1;             // the node that looks at the condition
  std::int32_t table = -1;              // of its four targets, among the operands
  std::size_t branches_begun = 0;
  std::size_t mark = 0;  // number of nodes when the branch in hand began
  std::array<std::int32_t, 3> results{};
  std::array<std::int32_t, 2> jumps{};
};

class ProgramBuilder {
 public:
  explicit ProgramBuilder(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  Operand constant(double value, const Span& at);
  // Stands for what could not be understood: NaN, which silences the checks of whatever uses it.
  Operand placeholder(const Span& at);
  Operand atom(const Atom& atom);
  Operand negate(const Operand& a, const Span& at);
  Operand binary(ExpressionNode::Kind kind, const Operand& a, const Operand& b);
  Operand power(const Operand& base, const Operand& exponent);
  // Reports arguments for which the function has no value, if they are constants.
  Operand call(const Function& function, std::span<const Operand> arguments, const Span& at);

  OpenIf open_if(const Operand& condition);
  void begin_branch(OpenIf& open);
  void end_branch(OpenIf& open, const Operand& result);
  Operand close_if(const OpenIf& open, const Span& at);

  // The program, with the atoms that are left after folding.
  std::shared_ptr<const ExpressionProgram> finish(const Span& at);

 private:
  using Kind = ExpressionNode::Kind;
  std::int32_t push(const ExpressionNode& node, const Span& at);
  void pop(std::size_t count);
  std::int32_t push_operands(std::span<const std::int32_t> nodes);
  std::int32_t next() const { return static_cast<std::int32_t>(program_.nodes.size()); }
  std::optional<double> constant_value(const Operand& operand) const;
  // Replaces a node whose operands are the last nodes, all constant, by its value.
  Operand fold(const ExpressionNode& node, std::span<const Operand> operands, const Span& at);
  void report_domain(std::string reason, const Span& at);

  Diagnostics& diagnostics_;
  ExpressionProgram program_;
  std::size_t branch_depth_ = 0;
};

}  // namespace dynalin

// Builds the flat program of an expression from its parts in post order, and folds constants on the
// way.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>

#include "base/diagnostics.h"
#include "expression/program_draft.h"

namespace dynalin {

// The result of a part of an expression: its node, and where the part stands.
struct Operand {
  std::int32_t node = -1;
  Span at;
  std::int32_t y = -1, z = -1;  // the other components of a vector
  bool unknown = false;         // stands for what could not be understood

  bool is_vector() const { return y >= 0; }
  Operand component(std::size_t k) const { return {k == 0 ? node : k == 1 ? y : z, at, -1, -1, unknown}; }
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
  // Of so many words, numbers and signs, each of which makes one node at the most where nothing is a vector.
  ProgramBuilder(Diagnostics& diagnostics, ProgramShapes& shapes, std::size_t words);
  ProgramBuilder(const ProgramBuilder&) = delete;
  ProgramBuilder& operator=(const ProgramBuilder&) = delete;
  ~ProgramBuilder();

  Operand constant(double value, const Span& at);
  // Stands for what could not be understood: NaN, which silences the checks of whatever uses it.
  Operand placeholder(const Span& at);
  Operand atom(const Atom& atom);
  Operand negate(const Operand& a, const Span& at);
  Operand binary(ExpressionNode::Kind kind, const Operand& a, const Operand& b);
  Operand power(const Operand& base, const Operand& exponent);
  // Reports arguments for which the function has no value, if they are constants.
  Operand call(const Function& function, std::span<const Operand> arguments, const Span& at);

  Operand spline(SplineUse use, const Operand& x, const Operand& z);

  // Vectors are three nodes; what is made of them is taken apart into scalars here.
  Operand vector(const Operand& x, const Operand& y, const Operand& z, const Span& at);
  Operand negate_vector(const Operand& v, const Span& at);
  Operand combine(ExpressionNode::Kind sum, const Operand& v, const Operand& w);  // v ± w
  Operand scale(ExpressionNode::Kind kind, const Operand& v, const Operand& s);   // v * s, v / s
  Operand dot(const Operand& v, const Operand& w);
  Operand cross(const Operand& v, const Operand& w);
  Operand magnitude(const Operand& v, const Span& at);
  Operand unit(const Operand& v, const Span& at);
  // Σ_b rows[a][b] v_b
  Operand transform(const std::array<Operand, 3>& rows, const Operand& v, const Span& at);

  // The value of a scalar that is known now.
  std::optional<double> constant_value(const Operand& operand) const;

  OpenIf open_if(const Operand& condition);
  void begin_branch(OpenIf& open);
  void end_branch(OpenIf& open, const Operand& result);
  Operand close_if(const OpenIf& open, const Span& at);

  // The program, with the atoms that are left after folding.
  std::shared_ptr<const ExpressionProgram> finish(const Span& at);

 private:
  // Reads combinations of angles that are smooth as one quantity (smooth_angles.cpp).
  void join_angles();
  using Kind = ExpressionNode::Kind;
  std::int32_t push(const DraftNode& node, const Span& at);
  void pop(std::size_t count);
  std::int32_t index_of(const Atom& atom);
  void drop_unused_atoms();
  std::int32_t push_operands(std::span<const std::int32_t> nodes);
  std::int32_t next() const { return static_cast<std::int32_t>(program_.nodes.size()); }
  // Replaces a node whose operands are all constant by its value.
  Operand fold(const DraftNode& node, std::span<const Operand> operands, const Span& at);
  void report_domain(std::string reason, const Span& at);
  // Of a vector of three measures, the measure that is its size.
  std::optional<Operand> size_of_measures(const Operand& v, const Span& at);

  Diagnostics& diagnostics_;
  ProgramShapes& shapes_;
  ProgramDraft program_;
  // By hash, of which distinct atoms may share one; empty as long as there are few.
  std::unordered_multimap<std::size_t, std::int32_t> atom_index_;
  std::size_t branch_depth_ = 0;
};

}  // namespace dynalin

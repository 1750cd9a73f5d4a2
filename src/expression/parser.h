// Reads the tokens of one expression and builds its program.
//
// Operators wait on a stack until a weaker one follows, and so do open parentheses; nothing here
// calls itself, so that an expression may be nested as deeply as it likes.
//
//     expr := term {(+|-) term}    term := unary {(*|/) unary}    unary := (+|-) unary | power
//     power := primary [** unary]  primary := number | name | name(…) | (expr)
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "dataset/dataset.h"
#include "expression/program_builder.h"

namespace dynalin {

class ExpressionParser {
 public:
  ExpressionParser(std::span<const Token> tokens, const SourceText& source, Diagnostics& diagnostics,
                   ProgramShapes& shapes);
  // Nothing after an error.
  std::shared_ptr<const ExpressionProgram> parse();
  // Parses a part of a DELAY, in which no other one may stand.
  std::shared_ptr<const ExpressionProgram> parse_within_delay() {
    within_delay_ = true;
    return parse();
  }
  // The same for one component of an expression whose value must be a vector.
  std::shared_ptr<const ExpressionProgram> parse_component(std::size_t component) {
    component_ = component;
    return parse();
  }

  // Takes the place of what is parsed: value `which` of a compiled routine that reads these atoms in this order.
  static Expression of_routine(std::vector<Atom> inputs, std::shared_ptr<const Routine>, std::size_t which,
                               const Span& at);

 private:
  // What was begun and waits for its end.
  struct Pending {
    enum class Kind : std::uint8_t {
      operation,     // a binary operator with its left operand
      negation,      // a sign
      group,         // an open parenthesis
      call,          // an open list of arguments
      if_condition,  // IF( before its colon
      if_branches,   // and behind it
      vector,        // an open bracket
      special,       // an open list of a function that takes vectors, or names a marker or spline by a constant
      not_built,     // an open list or vector of something that cannot be evaluated
    };
    Kind kind;
    std::string_view sign;  // of an operation
    Span at;                // of the operator, or of the function and the parenthesis
    const Function* function = nullptr;
    std::size_t first_operand = 0;  // of an open list, on the stack of operands
    const struct SpecialFunction* special = nullptr;
  };

  // Reading where an operand, or an operator, is expected.
  void read_operand();
  void read_operator();
  void read_name();
  void read_call(const Span& name, const std::string& upper);
  // One atom, or the three components of a vector function.
  void read_atom(std::span<const AtomFunction* const> components, const Span& name);
  void read_atom_argument(Atom& atom, std::size_t index);
  void check_atom(const Atom& atom);
  // DELAY (parser_delay.cpp).
  void read_delay(const AtomFunction& function, const Span& name);
  std::span<const Token> next_argument(Span& at);
  void report_unknown(const Span& name, const std::string& upper);
  void report_count(const Span& at, std::string_view name, std::size_t least, std::size_t most, std::size_t found);
  void report_not_built(const Span& at, std::string_view name);

  // Vectors (parser_vectors.cpp).
  Operand apply_to_vectors(const Pending& operation, const Operand& first, const Operand& last);
  Operand close_vector(const Pending& vector, const Span& at);
  Operand close_special(const Pending& call, const Span& at);
  Operand close_spline(const Pending& call, std::span<const Operand> arguments, const Span& at);
  Operand close_curve(std::span<const Operand> arguments, const Span& at);
  Operand close_spectrum(std::span<const Operand> arguments, const Span& at);
  Operand close_orientation(std::span<const Operand> arguments, const Span& at);
  std::optional<std::int32_t> constant_id(const Operand& operand, std::string_view meaning, std::int32_t least);
  bool check_scalar(const Operand& operand, std::string_view where);
  Operand marker_axis(std::size_t axis, const Atom& markers);

  // Grammar on the stacks.
  void push_operand(const Operand& operand);
  void push_operation(std::string_view sign, const Span& at);
  void open(Pending::Kind kind, const Span& at, const Function* function = nullptr);
  void apply_waiting(int weakest);  // operators that bind at least as tightly
  Operand apply(const Pending& operation);
  void end_argument();
  void end_condition();
  void close_parenthesis();
  void close_bracket();
  Operand close_call(const Pending& call, const Span& at);
  Operand close_if(const Span& at);
  std::shared_ptr<const ExpressionProgram> finish();

  // Tokens.
  bool at_end() const { return at_ >= tokens_.size(); }
  std::string_view text(std::size_t i) const;
  bool symbol_at(std::size_t i, std::string_view symbol) const;
  Span span(std::size_t i) const;
  void syntax_error(std::string_view code, const Span& at, std::string message, std::string hint = {});

  std::vector<Token> unmarked_;    // a copy without continuation marks, where there are any
  std::span<const Token> tokens_;  // without continuation marks
  const SourceText& source_;
  Diagnostics& diagnostics_;
  ProgramShapes& shapes_;
  std::size_t errors_before_;
  ProgramBuilder builder_;
  std::size_t at_ = 0;
  std::optional<std::size_t> component_;  // wanted of a vector
  bool within_delay_ = false;
  bool operand_expected_ = true;
  bool stopped_ = false;  // by an error in the grammar, after which nothing is certain
  Span nowhere_;          // where an empty expression would stand
  std::vector<Pending> pending_;
  std::vector<Operand> operands_;
  std::vector<OpenIf> ifs_;
};

}  // namespace dynalin

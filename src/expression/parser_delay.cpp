// DELAY(e, tau, history [, id]): three expressions of their own and a written id.
#include <fmt/format.h>

#include <limits>

#include "dataset/characters.h"
#include "dataset/tokens.h"
#include "expression/parser.h"

namespace dynalin {

// The tokens up to the comma or parenthesis behind the argument that begins here.
std::span<const Token> ExpressionParser::next_argument(Span& at) {
  const std::size_t first = at_;
  for (std::size_t depth = 0; !at_end(); ++at_) {
    if (depth == 0 && (symbol_at(at_, ",") || symbol_at(at_, ")"))) break;
    if (symbol_at(at_, "(") || symbol_at(at_, "[")) ++depth;
    if (depth > 0 && (symbol_at(at_, ")") || symbol_at(at_, "]"))) --depth;
  }
  at = at_ > first ? join(span(first), span(at_ - 1)) : span(std::min(first, tokens_.size() - 1));
  return std::span(tokens_).subspan(first, at_ - first);
}

void ExpressionParser::read_delay(const AtomFunction& function, const Span& name) {
  const std::size_t errors = diagnostics_.error_count();
  const Span opening = join(name, span(at_ + 1));
  at_ += 2;
  DelayedCall call;
  std::array<Expression*, 3> parts = {&call.value, &call.lag, &call.history};
  std::size_t count = 0;
  while (!at_end() && !(count == 0 && symbol_at(at_, ")"))) {
    Span at;
    const std::span<const Token> argument = next_argument(at);
    if (argument.empty()) {
      diagnostics_.error("missing-operand", at, fmt::format("argument {} of DELAY is missing", count + 1));
    } else if (count < parts.size() && !within_delay_) {
      if (auto program = ExpressionParser(argument, source_, diagnostics_, shapes_).parse_within_delay())
        *parts[count] = Expression(std::move(program));
      if (count == 0)
        for (const Token& t : argument) call.delayed += upper_case(token_text(t, source_));
    } else if (count == parts.size()) {
      const bool whole = argument.size() == 1 && argument[0].integer;
      const double id = whole ? token_value(argument[0], source_) : 0;
      const bool is_id = id >= 1 && id <= std::numeric_limits<std::int32_t>::max();
      if (is_id) call.array = static_cast<std::int32_t>(id), call.array_at = at;
      if (!is_id) {
        diagnostics_.error("expected-integer", at,
                           "argument 4 of DELAY is the id of an ARRAY, written as a whole number");
      }
    }
    ++count;
    if (!symbol_at(at_, ",")) break;
    ++at_;
  }
  if (at_end()) {
    return syntax_error("unbalanced-parenthesis", opening,
                        fmt::format("the parenthesis of '{}' is never closed", opening.text()));
  }
  Atom atom;
  atom.function = &function;
  atom.at = join(name, span(at_++));
  const bool no_errors = diagnostics_.error_count() == errors;
  if (no_errors && (count < function.minimum_arguments || count > function.maximum_arguments)) {
    report_count(atom.at, function.name, function.minimum_arguments, function.maximum_arguments, count);
  } else if (no_errors && within_delay_) {
    diagnostics_.error("function-not-built", atom.at,
                       "DELAY inside the arguments of another DELAY is not available yet");
  } else if (no_errors) {
    for (const Atom& a : call.history.atoms()) {
      if (a.function->family == AtomFamily::time) continue;
      diagnostics_.error(
          "function-of-state", a.at,
          fmt::format("argument 3 of DELAY is what was before the start: it may depend on TIME only, not "
                      "on {}",
                      a.function->name));
    }
  }
  if (diagnostics_.error_count() > errors) return push_operand(builder_.placeholder(atom.at));
  atom.delayed = std::make_shared<const DelayedCall>(std::move(call));
  push_operand(builder_.atom(atom));
}

}  // namespace dynalin

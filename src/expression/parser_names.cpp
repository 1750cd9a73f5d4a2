// The names of an expression: constants, functions, and atoms with their ids.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "dataset/characters.h"
#include "dataset/tokens.h"
#include "expression/function_manual.h"
#include "expression/parser.h"
#include "expression/vector_functions.h"

namespace dynalin {

namespace {

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::vector<std::string_view> all_names() {
  std::vector<std::string_view> names;
  for (const FunctionEntry& f : function_manual()) names.push_back(f.name);
  return names;
}

// TIME and MODE: an atom without arguments.
Atom named_atom(const AtomFunction& function, const Span& at) {
  Atom atom;
  atom.function = &function;
  atom.at = at;
  return atom;
}

// What an argument of an atom function is, for messages.
std::string argument_meaning(const AtomFunction& function, std::size_t index) {
  switch (reference_class(function, index)) {
    case ReferenceClass::marker:
      return "the id of a marker";
    case ReferenceClass::element:
      return fmt::format("the id of a {}", function.statement);
    case ReferenceClass::index:
      break;
  }
  return "a number";
}

}  // namespace

void ExpressionParser::read_name() {
  const Span name = span(at_);
  const std::string upper = upper_case(name.text());
  for (const NamedConstant& c : named_constants()) {
    if (c.name != upper) continue;
    ++at_;
    return push_operand(builder_.constant(c.value, name));
  }
  if (contains(names_not_built(), upper)) {
    ++at_;
    report_not_built(name, upper);
    return push_operand(builder_.placeholder(name));
  }
  const AtomFunction* atom = find_atom_function(upper);
  if (atom && atom->maximum_arguments == 0) {
    ++at_;
    return push_operand(builder_.atom(named_atom(*atom, name)));
  }
  if (!symbol_at(at_ + 1, "(")) {
    ++at_;
    const bool known = atom || upper == "IF" || find_function(upper) || find_vector_atom(upper) ||
                       find_special_function(upper) || contains(functions_not_built(), upper);
    if (known) {
      diagnostics_.error("missing-arguments", name, fmt::format("{} needs its arguments in parentheses", upper));
    } else {
      report_unknown(name, upper);
    }
    return push_operand(builder_.placeholder(name));
  }
  if (atom && atom->family == AtomFamily::delay) return read_delay(*atom, name);
  if (atom) return read_atom(std::array{atom}, name);
  if (const VectorAtom* v = find_vector_atom(upper)) {
    std::array<const AtomFunction*, 3> components;
    for (std::size_t k = 0; k < 3; ++k) components[k] = find_atom_function(v->components[k]);
    return read_atom(components, name);
  }
  read_call(name, upper);
}

void ExpressionParser::read_call(const Span& name, const std::string& upper) {
  const Span opening = join(name, span(at_ + 1));
  at_ += 2;
  if (upper == "IF") return open(Pending::Kind::if_condition, opening);
  if (const Function* function = find_function(upper)) {
    return open(Pending::Kind::call, opening, function);
  }
  if (const SpecialFunction* special = find_special_function(upper)) {
    open(Pending::Kind::special, opening);
    pending_.back().special = special;
    return;
  }
  if (contains(functions_not_built(), upper)) {
    report_not_built(name, upper);
  } else {
    report_unknown(name, upper);
  }
  // Its arguments are read all the same: they may hold errors of their own.
  open(Pending::Kind::not_built, opening);
}

void ExpressionParser::report_unknown(const Span& name, const std::string& upper) {
  const std::string_view near = nearest_word(upper, all_names());
  diagnostics_.error("unknown-function", name, fmt::format("{} is no function or constant of expressions", name.text()),
                     near.empty() ? "" : fmt::format("{} exists", near));
}

void ExpressionParser::report_not_built(const Span& at, std::string_view name) {
  if (name == "USER") {
    diagnostics_.error("routine-in-expression", at,
                       "USER(…) calls a compiled routine and is the whole of FUNCTION, and no part of an expression",
                       "VARIABLE/id, FUNCTION=USER(…) calls a routine, and expressions read VARVAL(id)");
    return;
  }
  diagnostics_.error("function-not-built", at, fmt::format("{} is not available yet", name));
}

void ExpressionParser::report_count(const Span& at, std::string_view name, std::size_t least, std::size_t most,
                                    std::size_t found) {
  const std::string wanted = least != most ? fmt::format("{} to {} arguments", least, most)
                             : least == 1  ? "1 argument"
                                           : fmt::format("{} arguments", least);
  diagnostics_.error("wrong-argument-count", at,
                     fmt::format("{} takes {}, here {} {}", name, wanted, found == 1 ? "is" : "are", found));
}

// The arguments of an atom are whole numbers: it is a quantity with a name, known before anything
// is evaluated.
void ExpressionParser::read_atom(std::span<const AtomFunction* const> components, const Span& name) {
  const AtomFunction& function = *components[0];
  const std::size_t errors = diagnostics_.error_count();
  Atom atom = named_atom(function, name);
  const Span opening = join(name, span(at_ + 1));
  if (!function.built) report_not_built(name, function.name);
  at_ += 2;
  std::size_t count = 0;
  while (!at_end() && !(count == 0 && symbol_at(at_, ")"))) {
    read_atom_argument(atom, count++);
    if (!symbol_at(at_, ",")) break;
    ++at_;
  }
  if (at_end()) {
    return syntax_error("unbalanced-parenthesis", opening,
                        fmt::format("the parenthesis of '{}' is never closed", opening.text()));
  }
  atom.at = join(name, span(at_++));  // with the closing parenthesis
  atom.argument_count = static_cast<std::uint8_t>(std::min(count, atom.argument.size()));
  if (diagnostics_.error_count() == errors) {
    if (count < function.minimum_arguments || count > function.maximum_arguments) {
      report_count(atom.at, function.name, function.minimum_arguments, function.maximum_arguments, count);
    } else {
      check_atom(atom);
    }
  }
  if (diagnostics_.error_count() > errors) return push_operand(builder_.placeholder(atom.at));
  if (components.size() == 1) return push_operand(builder_.atom(atom));
  std::array<Operand, 3> parts;
  for (std::size_t k = 0; k < 3; ++k) {
    atom.function = components[k];
    parts[k] = builder_.atom(atom);
  }
  push_operand(builder_.vector(parts[0], parts[1], parts[2], atom.at));
}

// Reads up to the comma or parenthesis behind the argument.
void ExpressionParser::read_atom_argument(Atom& atom, std::size_t index) {
  const std::size_t first = at_;
  for (std::size_t depth = 0; !at_end(); ++at_) {
    if (depth == 0 && (symbol_at(at_, ",") || symbol_at(at_, ")"))) break;
    if (symbol_at(at_, "(")) ++depth;
    if (symbol_at(at_, ")")) --depth;
  }
  if (at_end() || !atom.function->built) return;
  if (at_ == first) {
    diagnostics_.error("missing-operand", span(at_),
                       fmt::format("argument {} of {} is missing", index + 1, atom.function->name),
                       "write 0 for one that is left out");
    return;
  }
  const Span at = join(span(first), span(at_ - 1));
  const Token& token = tokens_[first];
  const double value = token.kind == TokenKind::number ? token_value(token, source_) : 0;
  const bool fits = value <= std::numeric_limits<std::int32_t>::max();
  if (at_ - first != 1 || !token.integer || !fits) {
    diagnostics_.error("expected-integer", at,
                       fmt::format("argument {} of {} is {}, written as a whole number", index + 1, atom.function->name,
                                   argument_meaning(*atom.function, index)));
    return;
  }
  if (index >= atom.argument.size()) return;
  atom.argument[index] = static_cast<std::int32_t>(value);
  atom.set_argument_at(index, at);
}

// The ranges that follow from the language alone.
void ExpressionParser::check_atom(const Atom& atom) {
  const AtomFunction& function = *atom.function;
  for (std::size_t k = 0; k < atom.argument_count; ++k) {
    std::int32_t least = 0, most = std::numeric_limits<std::int32_t>::max();
    switch (reference_class(function, k)) {
      case ReferenceClass::marker:
        least = k == 0 && function.family == AtomFamily::marker_force ? 1 : 0;  // nothing acts on the global frame
        break;
      case ReferenceClass::element:
        least = 1;
        break;
      case ReferenceClass::index:
        if (function.statement.empty()) {
          least = 1, most = 6;  // of a motion
        } else if (function.family != AtomFamily::element_force) {
          least = 1;  // a position in a list
        } else if (k == 1) {
          most = 1;  // force on the first marker or on the second
        } else {
          least = 1, most = 8;  // FM FX FY FZ TM TX TY TZ
        }
        break;
    }
    if (atom.argument[k] >= least && atom.argument[k] <= most) continue;
    const bool bounded = most != std::numeric_limits<std::int32_t>::max();
    diagnostics_.error("argument-range", atom.argument_at(k),
                       fmt::format("argument {} of {} is {}, here is {}", k + 1, function.name,
                                   bounded ? fmt::format("a number from {} to {}", least, most)
                                           : argument_meaning(function, k) + fmt::format(", {} or more", least),
                                   atom.argument[k]));
  }
}

}  // namespace dynalin

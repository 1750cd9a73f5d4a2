#include "expression/parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include "dataset/tokens.h"

namespace dynalin {

namespace {

constexpr int sum_precedence = 1, product_precedence = 2, sign_precedence = 3, power_precedence = 4;

int precedence(std::string_view sign) {
  if (sign == "+" || sign == "-") return sum_precedence;
  return sign == "**" ? power_precedence : product_precedence;
}

using Kind = ExpressionNode::Kind;

Kind operation_kind(std::string_view sign) {
  if (sign == "+") return Kind::add;
  if (sign == "-") return Kind::subtract;
  return sign == "/" ? Kind::divide : Kind::multiply;
}

bool is_operator(std::string_view symbol) {
  return symbol == "+" || symbol == "-" || symbol == "*" || symbol == "/" || symbol == "**" || symbol == "%";
}

}  // namespace

ExpressionParser::ExpressionParser(std::span<const Token> tokens, const SourceText& source, Diagnostics& diagnostics,
                                   ProgramShapes& shapes)
    : tokens_(tokens.begin(), std::ranges::find_if(tokens, [](const Token& t) { return t.kind == TokenKind::end; })),
      source_(source),
      diagnostics_(diagnostics),
      shapes_(shapes),
      errors_before_(diagnostics.error_count()),
      builder_(diagnostics, shapes, tokens.size()),
      nowhere_{&source, tokens.empty() ? 0 : tokens.front().offset, 0} {
  constexpr std::size_t some = 16;  // wait at the same time
  pending_.reserve(some), operands_.reserve(some);
  const auto is_mark = [](const Token& token) { return token.continuation; };
  if (std::ranges::none_of(tokens_, is_mark)) return;
  std::ranges::remove_copy_if(tokens_, std::back_inserter(unmarked_), is_mark);
  tokens_ = unmarked_;
}

std::shared_ptr<const ExpressionProgram> ExpressionParser::parse() {
  if (tokens_.empty()) {
    diagnostics_.error("empty-expression", nowhere_, "an expression is expected here");
    return nullptr;
  }
  while (!at_end() && !stopped_) {
    if (operand_expected_) {
      read_operand();
    } else {
      read_operator();
    }
  }
  return stopped_ ? nullptr : finish();
}

void ExpressionParser::read_operand() {
  const Token& token = tokens_[at_];
  if (token.kind == TokenKind::word) return read_name();
  if (token.kind == TokenKind::number) {
    const double value = token_value(token, source_);
    if (std::isinf(value)) {
      diagnostics_.error("number-overflow", span(at_), "this number is too large");
      push_operand(builder_.placeholder(span(at_)));
    } else {
      push_operand(builder_.constant(value, span(at_)));
    }
    ++at_;
  } else if (symbol_at(at_, "-")) {
    pending_.push_back({Pending::Kind::negation, "-", span(at_++), nullptr, operands_.size()});
  } else if (symbol_at(at_, "+")) {
    ++at_;
  } else if (symbol_at(at_, "(")) {
    open(Pending::Kind::group, span(at_++));
  } else if (symbol_at(at_, "[")) {
    open(Pending::Kind::vector, span(at_++));
  } else if (symbol_at(at_, ")") && at_ > 0 && symbol_at(at_ - 1, "(") && !pending_.empty() &&
             pending_.back().kind != Pending::Kind::group) {
    close_parenthesis();  // a list without arguments
  } else if (token.kind == TokenKind::symbol) {
    syntax_error("missing-operand", span(at_),
                 at_ == 0 ? fmt::format("a value is missing before '{}'", text(at_))
                          : fmt::format("a value is missing between '{}' and '{}'", text(at_ - 1), text(at_)));
  } else {
    syntax_error("bad-character", span(at_), fmt::format("'{}' has no meaning in an expression", text(at_)));
  }
}

void ExpressionParser::read_operator() {
  const std::string_view symbol = tokens_[at_].kind == TokenKind::symbol ? text(at_) : std::string_view();
  if (symbol == "*" && symbol_at(at_ + 1, "*")) {
    // The power sign written with a blank inside.
    push_operation("**", join(span(at_), span(at_ + 1)));
    at_ += 2;
  } else if (is_operator(symbol)) {
    push_operation(symbol, span(at_++));
  } else if (symbol == ",") {
    end_argument();
  } else if (symbol == ":") {
    end_condition();
  } else if (symbol == ")") {
    close_parenthesis();
  } else if (symbol == "]") {
    close_bracket();
  } else if (tokens_[at_].kind == TokenKind::other || (!symbol.empty() && symbol != "(" && symbol != "[")) {
    syntax_error("bad-character", span(at_), fmt::format("'{}' has no meaning in an expression", text(at_)));
  } else {
    const std::string_view next = text(at_);
    const bool exponent = at_ > 0 && tokens_[at_ - 1].kind == TokenKind::number && next.size() > 1 &&
                          (next.front() == 'D' || next.front() == 'd') &&
                          next.find_first_not_of("0123456789", 1) == std::string_view::npos;
    syntax_error("missing-operator", span(at_),
                 fmt::format("an operator is missing between '{}' and '{}'", text(at_ - 1), next),
                 exponent ? "an exponent begins with E, as in 2.5E0: D behind a number means degrees" : "");
  }
}

void ExpressionParser::push_operand(const Operand& operand) {
  operands_.push_back(operand);
  operand_expected_ = false;
}

void ExpressionParser::push_operation(std::string_view sign, const Span& at) {
  // ** is right associative: equal ones wait. It takes its right side with a sign, so a sign waits
  // too.
  const int own = precedence(sign);
  apply_waiting(sign == "**" ? own + 1 : own);
  pending_.push_back({Pending::Kind::operation, sign, at, nullptr, operands_.size()});
  operand_expected_ = true;
}

void ExpressionParser::open(Pending::Kind kind, const Span& at, const Function* function) {
  pending_.push_back({kind, "", at, function, operands_.size()});
  operand_expected_ = true;
}

void ExpressionParser::apply_waiting(int weakest) {
  while (!pending_.empty()) {
    const Pending& top = pending_.back();
    const bool sign = top.kind == Pending::Kind::negation;
    if (!sign && top.kind != Pending::Kind::operation) return;
    if ((sign ? sign_precedence : precedence(top.sign)) < weakest) return;
    const Operand result = apply(top);
    pending_.pop_back();
    operands_.push_back(result);
  }
}

Operand ExpressionParser::apply(const Pending& operation) {
  const Operand last = operands_.back();
  operands_.pop_back();
  if (operation.kind == Pending::Kind::negation) {
    const Span at = join(operation.at, last.at);
    return last.is_vector() ? builder_.negate_vector(last, at) : builder_.negate(last, at);
  }
  const Operand first = operands_.back();
  operands_.pop_back();
  if (first.is_vector() || last.is_vector() || operation.sign == "%") return apply_to_vectors(operation, first, last);
  if (operation.sign == "**") return builder_.power(first, last);
  return builder_.binary(operation_kind(operation.sign), first, last);
}

// After apply_waiting(sum_precedence) only open lists are left at the end of pending_.
void ExpressionParser::end_argument() {
  apply_waiting(sum_precedence);
  if (pending_.empty() || pending_.back().kind == Pending::Kind::group) {
    return syntax_error("misplaced-separator", span(at_),
                        pending_.empty() ? "a comma stands outside of any list of arguments"
                                         : "a comma stands in parentheses that hold one value");
  }
  if (pending_.back().kind == Pending::Kind::if_condition) {
    return syntax_error("misplaced-separator", span(at_), "the condition of IF ends with a colon, here is a comma",
                        "IF(condition: negative, zero, positive)");
  }
  if (pending_.back().kind == Pending::Kind::if_branches) {
    OpenIf& open_if = ifs_.back();
    check_scalar(operands_.back(), "a branch of IF");
    builder_.end_branch(open_if, operands_.back());
    if (open_if.branches_begun == 3) {
      return syntax_error("wrong-argument-count", span(at_),
                          "IF takes 3 values behind its condition, here is another one");
    }
    builder_.begin_branch(open_if);
  }
  ++at_;
  operand_expected_ = true;
}

void ExpressionParser::end_condition() {
  apply_waiting(sum_precedence);
  if (pending_.empty() || pending_.back().kind != Pending::Kind::if_condition) {
    return syntax_error("misplaced-separator", span(at_),
                        "a colon stands elsewhere than behind the condition of an IF");
  }
  check_scalar(operands_.back(), "the condition of IF");
  ifs_.push_back(builder_.open_if(operands_.back()));
  builder_.begin_branch(ifs_.back());
  operands_.pop_back();
  pending_.back().kind = Pending::Kind::if_branches;
  ++at_;
  operand_expected_ = true;
}

void ExpressionParser::close_parenthesis() {
  if (!operand_expected_) apply_waiting(sum_precedence);
  if (pending_.empty() || pending_.back().at.text().ends_with('[')) {
    return syntax_error("unbalanced-parenthesis", span(at_), "')' closes nothing");
  }
  const Pending list = pending_.back();
  const Span at = join(list.at, span(at_));
  Operand result;
  switch (list.kind) {
    case Pending::Kind::call:
      result = close_call(list, at);
      break;
    case Pending::Kind::if_condition:
      return syntax_error("wrong-argument-count", span(at_), "IF ends before the colon and its 3 values",
                          "IF(condition: negative, zero, positive)");
    case Pending::Kind::if_branches:
      result = close_if(at);
      break;
    case Pending::Kind::special:
      result = close_special(list, at);
      break;
    case Pending::Kind::group:
      result = operands_.back();
      result.at = at;
      break;
    default:
      result = builder_.placeholder(at);
  }
  pending_.pop_back();
  operands_.resize(list.first_operand);
  push_operand(result);
  ++at_;
}

void ExpressionParser::close_bracket() {
  apply_waiting(sum_precedence);
  if (pending_.empty() || !pending_.back().at.text().ends_with('[')) {
    return syntax_error("unbalanced-parenthesis", span(at_), "']' closes nothing");
  }
  const Pending vector = pending_.back();
  const Operand result = close_vector(vector, join(vector.at, span(at_++)));
  pending_.pop_back();
  operands_.resize(vector.first_operand);
  push_operand(result);
}

Operand ExpressionParser::close_call(const Pending& call, const Span& at) {
  const std::span arguments = std::span(operands_).subspan(call.first_operand);
  const Function& f = *call.function;
  for (const Operand& argument : arguments) {
    if (argument.is_vector() && !check_scalar(argument, fmt::format("an argument of {}", f.name)))
      return builder_.placeholder(at);
  }
  if (arguments.size() >= f.minimum_arguments && arguments.size() <= f.maximum_arguments) {
    return builder_.call(f, arguments, at);
  }
  report_count(at, f.name, f.minimum_arguments, f.maximum_arguments, arguments.size());
  return builder_.placeholder(at);
}

Operand ExpressionParser::close_if(const Span& at) {
  OpenIf open_if = ifs_.back();
  ifs_.pop_back();
  const std::size_t count = open_if.branches_begun;
  check_scalar(operands_.back(), "a branch of IF");
  builder_.end_branch(open_if, operands_.back());
  if (count == 3) return builder_.close_if(open_if, at);
  diagnostics_.error(
      "wrong-argument-count", at,
      fmt::format("IF takes 3 values behind its condition, here {} {}", count == 1 ? "is" : "are", count),
      "IF(condition: negative, zero, positive)");
  return builder_.placeholder(at);
}

std::shared_ptr<const ExpressionProgram> ExpressionParser::finish() {
  const std::size_t last = tokens_.size() - 1;
  const bool list_begun = symbol_at(last, "(") || symbol_at(last, ",") || symbol_at(last, ":") || symbol_at(last, "[");
  if (operand_expected_ && !list_begun) {
    syntax_error("missing-operand", span(last),
                 fmt::format("the expression ends behind '{}' where a value is expected", text(last)));
    return nullptr;
  }
  if (!operand_expected_) apply_waiting(sum_precedence);
  for (std::size_t k = pending_.size(); k-- > 0;) {
    const Pending& open = pending_[k];
    if (open.kind == Pending::Kind::operation || open.kind == Pending::Kind::negation) continue;
    const std::string_view opened = open.at.text();
    syntax_error("unbalanced-parenthesis", open.at,
                 opened.size() == 1 ? fmt::format("'{}' is never closed", opened)
                                    : fmt::format("the parenthesis of '{}' is never closed", opened));
    return nullptr;
  }
  if (!component_) {
    check_scalar(operands_.back(), "the value of the expression");
  } else if (operands_.back().is_vector()) {
    // The result is the last node: that of the component and a zero.
    const Operand wanted = operands_.back().component(*component_);
    builder_.binary(ExpressionNode::Kind::add, wanted, builder_.constant(0.0, wanted.at));
  } else if (!operands_.back().unknown) {
    diagnostics_.error("vector-mismatch", operands_.back().at, "a vector is expected here, this is a number");
  }
  if (diagnostics_.error_count() > errors_before_) return nullptr;
  return builder_.finish(join(span(0), span(last)));
}

std::string_view ExpressionParser::text(std::size_t i) const {
  return source_.text().substr(tokens_[i].offset, tokens_[i].length);
}

bool ExpressionParser::symbol_at(std::size_t i, std::string_view symbol) const {
  return i < tokens_.size() && tokens_[i].kind == TokenKind::symbol && text(i) == symbol;
}

Span ExpressionParser::span(std::size_t i) const { return {&source_, tokens_[i].offset, tokens_[i].length}; }

void ExpressionParser::syntax_error(std::string_view code, const Span& at, std::string message, std::string hint) {
  diagnostics_.error(code, at, std::move(message), std::move(hint));
  stopped_ = true;
}

Expression parse_expression(std::span<const Token> tokens, const SourceText& source, Diagnostics& diagnostics,
                            ProgramShapes& shapes) {
  auto program = ExpressionParser(tokens, source, diagnostics, shapes).parse();
  return program ? Expression(std::move(program)) : Expression();
}

Expression parse_expression(std::span<const Token> tokens, const SourceText& source, Diagnostics& diagnostics) {
  ProgramShapes alone;
  return parse_expression(tokens, source, diagnostics, alone);
}

VectorExpression parse_vector_expression(std::span<const Token> tokens, const SourceText& source,
                                         Diagnostics& diagnostics, ProgramShapes& shapes) {
  VectorExpression v;
  for (std::size_t k = 0; k < 3; ++k) {
    auto program = ExpressionParser(tokens, source, diagnostics, shapes).parse_component(k);
    if (!program) break;  // reported once
    v.component[k] = Expression(std::move(program));
  }
  return v;
}

}  // namespace dynalin

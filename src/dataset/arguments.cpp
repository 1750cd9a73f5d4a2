#include "dataset/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "dataset/characters.h"
#include "dataset/raw_text.h"
#include "dataset/tokens.h"

namespace dynalin {

namespace {

// An argument whose value is tokens[begin, end) of the statement.
struct ArgumentDraft {
  WrittenArgument argument;
  std::size_t begin = 0, end = 0;
};

constexpr std::size_t unmatched = std::numeric_limits<std::size_t>::max();

// Symbols of units that are no beginning of any argument.
bool is_unit(std::string_view word) {
  static constexpr std::array<std::string_view, 16> units = {"kg", "g",  "mm", "cm", "m",   "km",  "N",  "kN",
                                                             "mN", "Nm", "ms", "in", "rad", "deg", "lb", "lbf"};
  return std::find(units.begin(), units.end(), word) != units.end();
}

// Before the last digits of a number stands the letter or the sign of its exponent, if it has one.
bool has_exponent(std::string_view number) {
  if (!number.empty() && to_upper(number.back()) == 'D') number.remove_suffix(1);  // degrees
  while (!number.empty() && is_digit(number.back())) number.remove_suffix(1);
  return !number.empty() && std::string_view("eE+-").find(number.back()) != std::string_view::npos;
}

class ArgumentSplitter {
 public:
  ArgumentSplitter(std::span<const Token> tokens, std::string_view statement, const SourceText& source,
                   Diagnostics& diagnostics, SplitArguments& result)
      : tokens_(tokens), statement_(statement), source_(source), diagnostics_(diagnostics), result_(result) {
    match_parentheses();
  }

  void split() {
    result_.arguments.clear();
    result_.damaged = false;
    while (skip_separators()) {
      if (word_at(at_)) {
        read_argument();
      } else {
        report_unexpected("an argument is expected here");
      }
    }
  }

 private:
  // Questions about token i.
  bool symbol_at(std::size_t i, char symbol) const {
    return i < tokens_.size() && is_symbol(tokens_[i], source_, symbol);
  }
  bool word_at(std::size_t i) const { return i < tokens_.size() && tokens_[i].kind == TokenKind::word; }
  bool assignment_at(std::size_t i) const { return word_at(i) && symbol_at(i + 1, '='); }
  bool separator_or_end_at(std::size_t i) const {
    return i >= tokens_.size() || symbol_at(i, ',') || symbol_at(i, '\\');
  }
  std::string_view gap_before(std::size_t i) const {
    const std::size_t begin = tokens_[i - 1].offset + tokens_[i - 1].length;
    return source_.text().substr(begin, tokens_[i].offset - begin);
  }
  bool blank_before(std::size_t i) const { return !gap_before(i).empty(); }
  bool line_end_before(std::size_t i) const { return gap_before(i).find_first_of("\r\n") != std::string_view::npos; }
  // Behind an operand a word cannot go on with the same expression.
  bool ends_operand(std::size_t i) const {
    return tokens_[i].kind != TokenKind::symbol || symbol_at(i, ')') || symbol_at(i, ']');
  }
  // A word to which nothing is done: an argument without value, if an argument may begin here.
  bool stands_alone(std::size_t i) const {
    return word_at(i) && (separator_or_end_at(i + 1) || (word_at(i + 1) && blank_before(i + 1)));
  }
  // A comma, plain or a continuation mark, counts as one with the marks that directly follow it.
  std::size_t after_comma(std::size_t i) const {
    ++i;
    while (i < tokens_.size() && tokens_[i].continuation) ++i;
    return i;
  }
  Span span(std::size_t i) const { return token_span(tokens_[i], source_); }

  void match_parentheses();
  bool skip_separators();
  void report_unexpected(std::string_view expectation);
  void read_argument();
  void read_value(ArgumentDraft& draft);
  std::size_t end_of_text(std::size_t begin, ValueForm form) const;
  std::size_t end_of_text_list(std::size_t begin) const;
  std::size_t end_of_value(ArgumentDraft& draft);
  bool value_ends_at_comma(std::size_t begin, std::size_t comma, std::size_t next,
                           const WrittenArgument& argument) const;
  bool value_ends_before_word(std::size_t begin, std::size_t i, const WrittenArgument& argument) const;
  void check_tokens(ArgumentDraft& draft, ValueForm form);
  void check_number(ArgumentDraft& draft, std::size_t i);
  void check_quote(const ArgumentDraft& draft, ValueForm form, std::size_t i);
  void damage(WrittenArgument& argument, std::string_view code, std::size_t i, std::string message,
              std::string hint = {});

  std::span<const Token> tokens_;
  std::string_view statement_;
  const SourceText& source_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  SplitArguments& result_;
};

void ArgumentSplitter::match_parentheses() {
  result_.match.clear();
  std::vector<std::size_t>& open = result_.open;
  open.clear();
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    if (tokens_[i].kind != TokenKind::symbol) continue;
    const char symbol = source_.text()[tokens_[i].offset];
    if (symbol == '(' || symbol == '[') open.push_back(i);
    const bool round = symbol == ')';
    if (!round && symbol != ']') continue;
    if (open.empty() || !symbol_at(open.back(), round ? '(' : '[')) continue;
    if (result_.match.empty()) result_.match.assign(tokens_.size(), unmatched);
    result_.match[i] = open.back();
    result_.match[open.back()] = i;
    open.pop_back();
  }
}

// Moves to the next token that is no separator; false at the end of the statement.
bool ArgumentSplitter::skip_separators() {
  std::size_t commas = 0;
  while (at_ < tokens_.size()) {
    if (symbol_at(at_, ',')) {
      if (++commas == 2) {
        diagnostics_.warning("empty-argument", span(at_), "no argument stands before this comma");
      }
      at_ = after_comma(at_);
    } else if (symbol_at(at_, '\\')) {
      ++at_;
    } else {
      return true;
    }
  }
  return false;
}

// Goes on with the next argument that is beyond doubt.
void ArgumentSplitter::report_unexpected(std::string_view expectation) {
  result_.damaged = true;
  const bool closes = symbol_at(at_, ')') || symbol_at(at_, ']');
  const std::string_view code = tokens_[at_].kind == TokenKind::other ? "bad-character"
                                : symbol_at(at_, '=')                 ? "stray-equals"
                                : closes                              ? "unbalanced-parenthesis"
                                                                      : "unexpected-text";
  diagnostics_.error(code, span(at_), std::string(expectation) + ", found " + quoted(tokens_[at_], source_));
  for (++at_; at_ < tokens_.size() && !symbol_at(at_, '\\'); ++at_) {
    if (!symbol_at(at_, ',')) continue;
    const std::size_t next = after_comma(at_);
    if (next >= tokens_.size() || assignment_at(next) || stands_alone(next)) return;
  }
}

void ArgumentSplitter::read_argument() {
  ArgumentDraft draft;
  draft.argument.name = span(at_);
  draft.begin = draft.end = ++at_;
  const bool has_value = symbol_at(at_, '=');
  if (has_value) read_value(draft);
  result_.damaged = result_.damaged || draft.argument.damaged;
  result_.arguments.push_back(draft.argument);
  if (has_value || separator_or_end_at(at_) || (word_at(at_) && blank_before(at_))) return;
  report_unexpected("a comma or '=' is expected after " + std::string(draft.argument.name.text()));
}

void ArgumentSplitter::read_value(ArgumentDraft& draft) {
  WrittenArgument& argument = draft.argument;
  const std::size_t equals = at_++;
  if (symbol_at(at_, '=')) {
    diagnostics_.error("stray-equals", span(at_), "a second '=' stands behind " + std::string(argument.name.text()));
    result_.damaged = true;
    while (symbol_at(at_, '=')) ++at_;
  }
  const ValueForm form = value_form(statement_, argument.name.text());
  // The value may begin on the next line, but for a comment, which may be empty.
  const std::size_t behind_marks = after_comma(at_ - 1);
  if (form != ValueForm::rest_of_line && !assignment_at(behind_marks)) at_ = behind_marks;
  argument.has_value = true;
  draft.begin = draft.end = at_;
  at_ = form == ValueForm::tokens      ? end_of_value(draft)
        : form == ValueForm::text_list ? end_of_text_list(at_)
        : form == ValueForm::free_text ? tokens_.size()
                                       : end_of_text(at_, form);
  draft.end = at_;
  if (draft.begin < draft.end) {
    argument.set_value(tokens_.subspan(draft.begin, draft.end - draft.begin));
    check_tokens(draft, form);
    return;
  }
  argument.set_empty_value(tokens_[equals].offset + 1);
  if (form == ValueForm::rest_of_line) return;
  if (form == ValueForm::free_text || form == ValueForm::text_list) {
    diagnostics_.warning("missing-value", span(equals), std::string(argument.name.text()) + " has no value after '='");
    return;
  }
  damage(argument, "missing-value", equals, std::string(argument.name.text()) + " has no value after '='");
}

// Raw text ends with the line, at a comma, or where another assignment begins without doubt.
std::size_t ArgumentSplitter::end_of_text(std::size_t begin, ValueForm form) const {
  for (std::size_t i = begin; i < tokens_.size(); ++i) {
    if ((i > begin || form == ValueForm::rest_of_line) && line_end_before(i)) return i;
    if (symbol_at(i, '\\')) {
      const std::size_t next = symbol_at(i + 1, ',') ? after_comma(i + 1) : i + 1;
      if (assignment_at(next)) return i;
    }
    if (form == ValueForm::rest_of_line) {
      const bool argument_follows =
          symbol_at(i, ',') && assignment_at(i + 1) && ends_comment(token_text(tokens_[i + 1], source_));
      if (argument_follows) return i;
      continue;
    }
    if (symbol_at(i, ',')) return i;
    if (i > begin && assignment_at(i) && blank_before(i)) return i;
  }
  return tokens_.size();
}

// Lists go on behind a comma and over lines. Among quoted texts only quotes and empty places belong to the list, among
// bare words everything that is no argument.
std::size_t ArgumentSplitter::end_of_text_list(std::size_t begin) const {
  const auto quoted_at = [&](std::size_t i) {
    return i < tokens_.size() && tokens_[i].kind == TokenKind::other &&
           (source_.text()[tokens_[i].offset] == '"' || source_.text()[tokens_[i].offset] == '\'');
  };
  const bool in_quotes = quoted_at(begin) || symbol_at(begin, ',');
  std::size_t i = begin;
  while (i < tokens_.size() && !symbol_at(i, '\\')) {
    if (!symbol_at(i, ',')) {
      if (i > begin && assignment_at(i)) return i;
      ++i;
      continue;
    }
    const std::size_t next = after_comma(i);
    if (next >= tokens_.size() || assignment_at(next)) return i;
    const bool belongs =
        symbol_at(next, ',') ||
        (in_quotes ? quoted_at(next)
                   : !(stands_alone(next) && ends_text_list(statement_, token_text(tokens_[next], source_))));
    if (!belongs) return i;
    i = next;
  }
  return i;
}

std::size_t ArgumentSplitter::end_of_value(ArgumentDraft& draft) {
  WrittenArgument& argument = draft.argument;
  std::size_t i = draft.begin;
  while (i < tokens_.size() && !symbol_at(i, '\\')) {
    if (tokens_[i].kind == TokenKind::number) {
      ++i;
    } else if (symbol_at(i, ',')) {
      std::size_t next = after_comma(i);
      while (symbol_at(next, ',')) next = after_comma(next);
      if (value_ends_at_comma(draft.begin, i, next, argument)) return i;
      i = next;
    } else if (word_at(i)) {
      if (i > draft.begin && value_ends_before_word(draft.begin, i, argument)) return i;
      ++i;
    } else if (symbol_at(i, '=')) {
      damage(argument, "stray-equals", i, "'=' stands inside of a value",
             "a comma may be missing before the name of the argument");
      ++i;
    } else if (!result_.match.empty() && result_.match[i] != unmatched) {
      for (const std::size_t close = result_.match[i]; i < close; ++i) {
        if (symbol_at(i, '=')) damage(argument, "stray-equals", i, "'=' stands inside of parentheses");
      }
      ++i;
    } else {
      const bool opens = symbol_at(i, '(') || symbol_at(i, '[');
      const bool closes = symbol_at(i, ')') || symbol_at(i, ']');
      if (opens || closes) {
        damage(argument, "unbalanced-parenthesis", i,
               quoted(tokens_[i], source_) + (opens ? " is never closed" : " closes nothing"));
      }
      ++i;
    }
  }
  return i;
}

// `next` is the first token behind the comma and all commas that follow it.
bool ArgumentSplitter::value_ends_at_comma(std::size_t begin, std::size_t comma, std::size_t next,
                                           const WrittenArgument& argument) const {
  if (comma == begin) return true;
  if (next < tokens_.size() && tokens_[next].kind == TokenKind::number) return false;  // a list, as most values are
  if (separator_or_end_at(next) || assignment_at(next)) return true;
  // Inside of what a missing parenthesis left open, a lone word is rather an operand.
  if (argument.damaged || !word_at(next)) return false;
  const bool expression_is_open = tokens_[comma].continuation && !ends_operand(comma - 1);
  return !expression_is_open && stands_alone(next);
}

// A forgotten comma: a complete operand, and then an argument.
bool ArgumentSplitter::value_ends_before_word(std::size_t begin, std::size_t i, const WrittenArgument& argument) const {
  if (i <= begin || !ends_operand(i - 1)) return false;
  if (assignment_at(i)) return true;
  // A unit behind a number is left to the reader of the value, which says what is wrong with it.
  if (tokens_[i - 1].kind == TokenKind::number && is_unit(token_text(tokens_[i], source_))) return false;
  return !argument.damaged && blank_before(i) && stands_alone(i);
}

void ArgumentSplitter::check_tokens(ArgumentDraft& draft, ValueForm form) {
  for (std::size_t i = draft.begin; i < draft.end; ++i) {
    const Token& token = tokens_[i];
    if (token.kind == TokenKind::other) {
      check_quote(draft, form, i);
      const auto byte = static_cast<unsigned char>(source_.text()[token.offset]);
      if (byte >= 0x20 && byte != 0x7F) continue;
      if (form == ValueForm::free_text) {
        diagnostics_.warning("bad-character", span(i),
                             quoted(token, source_) + " stands in the text of " +
                                 std::string(draft.argument.name.text()) + " and is kept");
        continue;
      }
      damage(draft.argument, "bad-character", i,
             quoted(token, source_) + " stands in the value of " + std::string(draft.argument.name.text()));
    }
    if (form == ValueForm::tokens && token.kind == TokenKind::number) check_number(draft, i);
  }
}

// A quoted text ends in its line; a quote that opens one and has no partner is a part of the text.
void ArgumentSplitter::check_quote(const ArgumentDraft& draft, ValueForm form, std::size_t i) {
  const bool names = form == ValueForm::text || form == ValueForm::text_list;
  const std::string_view text = token_text(tokens_[i], source_);
  if (!names || (text != "\"" && text != "'")) return;
  if (i > draft.begin && !symbol_at(i - 1, ',')) return;
  diagnostics_.warning(
      "bad-character", span(i),
      fmt::format("the quote that opens here in {} is not closed in its line", draft.argument.name.text()),
      "what follows counts as one text");
}

void ArgumentSplitter::check_number(ArgumentDraft& draft, std::size_t i) {
  // Only very long numbers and those with an exponent may be out of the range of double.
  constexpr std::uint32_t short_number = 300;
  const std::string_view text = token_text(tokens_[i], source_);
  if (tokens_[i].length > short_number || has_exponent(text)) {
    const double value = token_value(tokens_[i], source_);
    if (std::isinf(value)) damage(draft.argument, "number-overflow", i, "this number is too large");
    const std::string_view mantissa = text.substr(0, text.find_first_of("eE"));
    if (value == 0 && mantissa.find_first_of("123456789") != std::string_view::npos)
      diagnostics_.warning("number-underflow", span(i), "this number is too small and is read as 0");
  }
  if (!tokens_[i].degrees) return;
  const bool sign = symbol_at(i + 1, '+') || symbol_at(i + 1, '-');
  const bool like_exponent =
      sign && i + 2 < draft.end && tokens_[i + 2].integer && !blank_before(i + 1) && !blank_before(i + 2);
  // Written as nobody writes an exponent, and going on as a sum does: 30D+2*TIME.
  const auto is_sum = [&] {
    const std::string_view next = i + 3 < draft.end ? token_text(tokens_[i + 3], source_) : " ";
    const bool goes_on = std::string_view("*/+-").find(next.front()) != std::string_view::npos;
    return goes_on && text.find('.') == std::string_view::npos && token_text(tokens_[i + 2], source_).front() != '0';
  };
  if (like_exponent && !is_sum()) {
    diagnostics_.warning("degrees-not-exponent", join(span(i), span(i + 2)),
                         "D means degrees here and begins no exponent",
                         "write E for an exponent, or a blank before the sign");
  }
}

// One argument has one error: what goes wrong behind it is most often its consequence.
void ArgumentSplitter::damage(WrittenArgument& argument, std::string_view code, std::size_t i, std::string message,
                              std::string hint) {
  if (!argument.damaged) {
    diagnostics_.error(code, span(i), std::move(message), std::move(hint));
  }
  argument.damaged = true;
}

}  // namespace

void split_arguments(std::span<const Token> tokens, std::string_view statement, const SourceText& source,
                     Diagnostics& diagnostics, SplitArguments& result) {
  ArgumentSplitter(tokens, statement, source, diagnostics, result).split();
}

}  // namespace dynalin

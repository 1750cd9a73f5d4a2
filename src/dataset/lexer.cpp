#include "dataset/lexer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "dataset/characters.h"
#include "dataset/number.h"

namespace dynalin {

namespace {

constexpr auto symbols = [] {
  std::array<bool, 256> table{};
  for (const char c : std::string_view(",=:/\\()[]+-*%")) table[static_cast<unsigned char>(c)] = true;
  return table;
}();
constexpr bool is_symbol(char c) { return symbols[static_cast<unsigned char>(c)]; }

constexpr auto word_parts = [] {
  std::array<bool, 256> table{};
  for (std::size_t byte = 0; byte < table.size(); ++byte) table[byte] = is_word_part(static_cast<char>(byte));
  return table;
}();

// A quote opens a quoted text only where a value may begin, so that the one in `Peter's` does not.
constexpr bool may_open_quote(char previous) {
  return is_blank(previous) || is_line_end(previous) || is_symbol(previous);
}

}  // namespace

Lexer::Lexer(const SourceText& source, std::uint32_t start) : text_(source.text()), at_(start) {}

bool Lexer::next_statement(std::vector<Token>& tokens) {
  tokens.clear();
  while (tokens.empty()) {
    skip_blank_lines_and_comments();
    while (!at_end() && text_[at_] == ';') {
      ++at_;
      skip_blank_lines_and_comments();
    }
    view_name_ = std::exchange(pending_view_name_, {});
    if (at_end()) return false;
    scan_statement(tokens);
  }
  return true;
}

void Lexer::scan_statement(std::vector<Token>& tokens) {
  while (!at_end()) {
    const char c = text_[at_];
    if (is_blank(c)) {
      ++at_;
    } else if (is_line_end(c)) {
      if (!statement_continues(tokens)) return;
    } else if (c == '!') {
      skip_comment();
    } else if (c == ';') {
      ++at_;
      return;
    } else if (c == '&' && skip_ampersand()) {
      statement_continues(tokens);  // a comma mark may follow; the statement goes on either way
    } else {
      scan_token(tokens);
    }
  }
}

void Lexer::skip_blanks() {
  while (!at_end() && is_blank(text_[at_])) ++at_;
}

void Lexer::skip_comment() {
  constexpr std::string_view key = "adams_view_name";
  const std::size_t begin = at_ + 1;
  while (!at_end() && !is_line_end(text_[at_])) ++at_;
  std::string_view comment = text_.substr(begin, at_ - begin);

  const auto drop_blanks = [&] {
    while (!comment.empty() && is_blank(comment.front())) comment.remove_prefix(1);
  };
  drop_blanks();
  if (!begins_with_ignoring_case(comment, key)) return;
  comment.remove_prefix(key.size());
  drop_blanks();
  if (comment.empty() || comment.front() != '=') return;
  comment.remove_prefix(1);
  drop_blanks();
  if (comment.empty() || (comment.front() != '\'' && comment.front() != '"')) return;
  const char quote = comment.front();
  comment.remove_prefix(1);
  pending_view_name_ = comment.substr(0, comment.find(quote));
}

void Lexer::skip_blank_lines_and_comments() {
  while (!at_end()) {
    const char c = text_[at_];
    if (c == '!') {
      skip_comment();
    } else if (is_blank(c) || is_line_end(c)) {
      ++at_;
    } else {
      return;
    }
  }
}

// At a line end: whether the next line that is neither blank nor comment begins with the mark.
bool Lexer::statement_continues(std::vector<Token>& tokens) {
  skip_blank_lines_and_comments();
  if (at_end() || text_[at_] != ',') return false;
  push(tokens, TokenKind::symbol, 1);
  tokens.back().continuation = true;
  return true;
}

// An ampersand continues the line only when nothing but a comment follows it there.
bool Lexer::skip_ampersand() {
  const std::size_t mark = at_++;
  skip_blanks();
  if (at_end() || is_line_end(text_[at_]) || text_[at_] == '!') return true;
  at_ = mark;
  return false;
}

void Lexer::scan_token(std::vector<Token>& tokens) {
  const char c = text_[at_];
  const bool point_and_digit = c == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]);
  if (is_digit(c) || point_and_digit) return scan_number(tokens);
  if (is_word_start(c)) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && word_parts[static_cast<unsigned char>(text_[end])]) ++end;
    return push(tokens, TokenKind::word, end - at_);
  }
  if (is_symbol(c)) {
    const bool power = c == '*' && at_ + 1 < text_.size() && text_[at_ + 1] == '*';
    return push(tokens, TokenKind::symbol, power ? 2 : 1);
  }
  scan_other(tokens);
}

void Lexer::scan_number(std::vector<Token>& tokens) {
  const NumberExtent extent = number_extent(text_.substr(at_), ExponentLetter::e);
  const std::size_t end = at_ + extent.length;
  const bool degrees =
      end < text_.size() && to_upper(text_[end]) == 'D' && (end + 1 == text_.size() || !is_word_part(text_[end + 1]));
  push(tokens, TokenKind::number, extent.length + (degrees ? 1 : 0));
  tokens.back().degrees = degrees;
  tokens.back().integer = !degrees && !extent.has_point && !extent.has_exponent;
}

void Lexer::scan_other(std::vector<Token>& tokens) {
  const char c = text_[at_];
  std::size_t end = at_ + 1;
  if ((c == '\'' || c == '"') && (at_ == 0 || may_open_quote(text_[at_ - 1]))) {
    while (end < text_.size() && text_[end] != c && !is_line_end(text_[end])) ++end;
    const bool closed = end < text_.size() && text_[end] == c;
    return push(tokens, TokenKind::other, closed ? end + 1 - at_ : 1);
  }
  // The bytes of one character, and garbage that stands together, make one token.
  const auto is_foreign = [](char byte) {
    return static_cast<unsigned char>(byte) >= 0x7F ||
           (static_cast<unsigned char>(byte) < 0x20 && !is_blank(byte) && !is_line_end(byte));
  };
  if (is_foreign(c)) {
    while (end < text_.size() && is_foreign(text_[end])) ++end;
  }
  push(tokens, TokenKind::other, end - at_);
}

void Lexer::push(std::vector<Token>& tokens, TokenKind kind, std::size_t length) {
  const auto push_one = [&](std::size_t part) {
    Token token;
    token.offset = static_cast<std::uint32_t>(at_);
    token.length = static_cast<std::uint32_t>(part) & Token::longest;
    token.kind = kind;
    tokens.push_back(token);
    at_ += part;
  };
  // What is longer than a token can be becomes several, none of which is what it was meant to be.
  for (; length > Token::longest; length -= Token::longest) push_one(Token::longest);
  push_one(length);
}

}  // namespace dynalin

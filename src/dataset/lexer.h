// From bytes to the tokens of one statement at a time. Line ends, blanks, comments, continuation
// marks and the names in comments are resolved here and nowhere else.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "dataset/dataset.h"

namespace dynalin {

class Lexer {
 public:
  // Starts reading at byte `start`; the source must outlive the lexer.
  Lexer(const SourceText& source, std::uint32_t start);

  // Replaces `tokens` by those of the next statement, at least one; false at the end of the text.
  bool next_statement(std::vector<Token>& tokens);
  // The name out of the comments between the statement just read and the one before it.
  std::string_view view_name() const { return view_name_; }
  // Where reading goes on.
  std::uint32_t position() const { return static_cast<std::uint32_t>(at_); }

 private:
  bool at_end() const { return at_ >= text_.size(); }
  void skip_blanks();
  void skip_comment();
  void skip_blank_lines_and_comments();
  void scan_statement(std::vector<Token>& tokens);
  bool statement_continues(std::vector<Token>& tokens);
  bool skip_ampersand();
  void scan_token(std::vector<Token>& tokens);
  void scan_number(std::vector<Token>& tokens);
  void scan_other(std::vector<Token>& tokens);
  void push(std::vector<Token>& tokens, TokenKind kind, std::size_t length);

  std::string_view text_;
  std::size_t at_;
  std::string_view view_name_, pending_view_name_;
};

}  // namespace dynalin

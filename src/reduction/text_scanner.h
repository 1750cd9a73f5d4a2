// Words and numbers along the lines of one file, with their places: matrices have millions of lines.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "base/source.h"

namespace dynalin::reduction {

class TextScanner {
 public:
  explicit TextScanner(const SourceText& file) : file_(file), text_(file.text()) {}

  // The next line, without its end; false behind the last.
  bool next_line() {
    if (after_ >= text_.size()) return false;
    at_ = begin_ = after_;
    const std::size_t end = text_.find_first_of("\r\n", begin_);
    end_ = end == std::string_view::npos ? text_.size() : end;
    after_ = end_;
    if (after_ < text_.size()) after_ += text_[after_] == '\r' && text_.substr(after_, 2) == "\r\n" ? 2 : 1;
    return true;
  }
  std::string_view line() const { return text_.substr(begin_, end_ - begin_); }
  Span line_span() const { return span(begin_, end_); }
  // Behind the last word of the line.

  // The next word of the line, ended by blanks or a comma; empty at its end.
  std::string_view word() {
    while (at_ < end_ && separates(text_[at_])) ++at_;
    word_ = at_;
    while (at_ < end_ && !separates(text_[at_])) ++at_;
    return text_.substr(word_, at_ - word_);
  }
  // Of the last word.
  Span word_span() const { return span(word_, at_); }

  template <class Integer>
  static std::optional<Integer> integer(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    Integer value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
  }
  // Exponents may have the letter D. What is too small for a number is zero; what is too large is none.
  static std::optional<double> real(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end == word.data() + word.size() && error == std::errc{}) return finite(value);
    if (word.empty() || error == std::errc::invalid_argument) return std::nullopt;
    std::string with_e(word);
    for (char& c : with_e) c = c == 'D' || c == 'd' ? 'E' : c;
    const char* last = with_e.data() + with_e.size();
    const auto again = std::from_chars(with_e.data(), last, value);
    if (again.ptr != last) return std::nullopt;
    if (again.ec == std::errc::result_out_of_range) return is_small(with_e) ? std::optional(0.0) : std::nullopt;
    return again.ec == std::errc{} ? finite(value) : std::nullopt;
  }

 private:
  static bool separates(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\f' || c == '\v'; }
  static std::optional<double> finite(double v) { return std::isfinite(v) ? std::optional(v) : std::nullopt; }
  static bool is_small(const std::string& word) { return word.find("E-") != word.npos || word.find("e-") != word.npos; }
  Span span(std::size_t begin, std::size_t end) const {
    return {&file_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)};
  }

  const SourceText& file_;
  std::string_view text_;
  std::size_t begin_ = 0, end_ = 0, after_ = 0, at_ = 0, word_ = 0;
};

}  // namespace dynalin::reduction

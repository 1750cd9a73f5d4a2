// Classes of characters and comparison without regard to case, in ASCII whatever the locale.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace dynalin {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
constexpr bool is_word_start(char c) { return is_letter(c) || c == '_'; }
constexpr bool is_word_part(char c) { return is_word_start(c) || is_digit(c); }
constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }
constexpr bool is_line_end(char c) { return c == '\n' || c == '\r'; }
constexpr char to_upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
constexpr char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

inline std::string upper_case(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) c = to_upper(c);
  return upper;
}

inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = to_lower(c);
  return lower;
}

constexpr bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) { return to_upper(x) == to_upper(y); });
}

// Whether `word` begins with `beginning`.
constexpr bool begins_with_ignoring_case(std::string_view word, std::string_view beginning) {
  return word.size() >= beginning.size() && equal_ignoring_case(word.substr(0, beginning.size()), beginning);
}

}  // namespace dynalin

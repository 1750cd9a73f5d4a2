#include "nastran_reader/field.h"

#include <cctype>
#include <charconv>

#include "nastran_reader/deck_lines.h"

namespace dynalin::nastran_reader {

namespace {

bool digit(char c) { return c >= '0' && c <= '9'; }

// The shape of a number, as far as it is one.
struct Shape {
  bool number = false;  // as a whole
  bool point = false, exponent = false, doubled = false;
  std::string plain;  // with E, as from_chars reads it
};

Shape shape_of(std::string_view s) {
  Shape shape;
  std::size_t i = 0;
  if (i < s.size() && (s[i] == '+' || s[i] == '-')) {
    if (s[i] == '-') shape.plain += '-';
    ++i;
  }
  std::size_t digits = 0;
  for (; i < s.size() && (digit(s[i]) || (s[i] == '.' && !shape.point)); ++i) {
    if (s[i] == '.') shape.point = true;
    digits += digit(s[i]);
    // A point needs digits on both sides for no reader but some.
    if (s[i] == '.' && digits == 0) shape.plain += '0';
    shape.plain += s[i];
  }
  if (digits == 0) return shape;
  if (!shape.plain.empty() && shape.plain.back() == '.') shape.plain += '0';
  if (i < s.size()) {
    const char c = s[i];
    const bool letter = c == 'E' || c == 'D';
    if (!letter && c != '+' && c != '-') return shape;
    shape.exponent = true;
    shape.doubled = c == 'D';
    shape.plain += 'e';
    if (letter) ++i;
    if (i < s.size() && (s[i] == '+' || s[i] == '-')) {
      if (s[i] == '-') shape.plain += '-';
      ++i;
    }
    std::size_t exponent_digits = 0;
    for (; i < s.size() && digit(s[i]); ++i, ++exponent_digits) shape.plain += s[i];
    if (exponent_digits == 0) return shape;
  }
  shape.number = i == s.size();
  return shape;
}

bool word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

}  // namespace

Field read_field(std::string_view text, const Span& at) {
  Field f;
  f.text = upper_trimmed(text);
  f.at = at;
  const auto wrong = [&](std::string_view reason) {
    f.form = Field::Form::wrong;
    f.reason = reason;
    return f;
  };
  if (f.text.empty()) return f;
  for (const char c : f.text) {
    if (std::isspace(static_cast<unsigned char>(c))) return wrong("a blank stands within it");
  }
  if (std::isalpha(static_cast<unsigned char>(f.text[0]))) {
    if (f.text.find('.') != std::string::npos) return wrong("a name has no point and a number begins with no letter");
    f.form = Field::Form::word;
    return f;
  }
  const Shape shape = shape_of(f.text);
  if (!shape.number) {
    bool word = true;
    for (const char c : f.text) word = word && word_character(c);
    return wrong(word ? "it is no number, and a name begins with a letter" : "it is no number");
  }
  if (!shape.point && shape.exponent) return wrong("a real has a decimal point");
  if (!shape.point) {
    std::string_view digits = f.text;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), f.integer);
    if (read.ec != std::errc()) return wrong("it is too large for an integer");
    f.real = f.integer;
    f.form = Field::Form::integer;
    return f;
  }
  const auto read = std::from_chars(shape.plain.data(), shape.plain.data() + shape.plain.size(), f.real);
  if (read.ec == std::errc::result_out_of_range) {
    // Below the least number it is zero, above the greatest it is none.
    const std::size_t e = shape.plain.find('e');
    if (e == std::string::npos || shape.plain[e + 1] != '-') return wrong("it is too large for a real");
    f.real = 0;
  }
  f.double_precision = shape.doubled;
  f.form = Field::Form::real;
  return f;
}

}  // namespace dynalin::nastran_reader

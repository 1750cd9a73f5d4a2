#include "dataset/number.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>

#include "dataset/characters.h"

namespace dynalin {

namespace {

std::size_t skip_digits(std::string_view text, std::size_t i) {
  while (i < text.size() && is_digit(text[i])) ++i;
  return i;
}

// Whether a number out of the range of double is too large (and not too small): sign of its decimal
// exponent.
bool is_huge(std::string_view text) {
  const std::size_t letter = text.find_first_of("eE");
  const std::string_view mantissa = text.substr(0, letter);
  std::int64_t exponent = 0;
  if (letter != std::string_view::npos) {
    const bool negative = text[letter + 1] == '-';
    const bool has_sign = negative || text[letter + 1] == '+';
    for (const char c : text.substr(letter + (has_sign ? 2 : 1))) {
      if (exponent < 1'000'000'000'000) exponent = 10 * exponent + (c - '0');
    }
    if (negative) exponent = -exponent;
  }
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) return false;
  return exponent + static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first) > 0;
}

double convert(std::string_view text) {
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc::result_out_of_range) return value;
  return is_huge(text) ? std::numeric_limits<double>::infinity() : 0.0;
}

}  // namespace

NumberExtent number_extent(std::string_view text, ExponentLetter letter) {
  NumberExtent extent;
  std::size_t i = skip_digits(text, 0);
  std::size_t digits = i;
  if (i < text.size() && text[i] == '.') {
    extent.has_point = true;
    const std::size_t end = skip_digits(text, i + 1);
    digits += end - i - 1;
    i = end;
  }
  if (digits == 0) return {};
  extent.length = i;
  if (i == text.size()) return extent;

  const char c = to_upper(text[i]);
  if (c != 'E' && !(c == 'D' && letter == ExponentLetter::e_or_d)) return extent;
  std::size_t start = i + 1;
  if (start < text.size() && (text[start] == '+' || text[start] == '-')) ++start;
  const std::size_t end = skip_digits(text, start);
  if (end == start) return extent;
  extent.length = end;
  extent.has_exponent = true;
  return extent;
}

double number_value(std::string_view text) {
  // Short whole numbers are by far the most frequent.
  if (text.size() <= 9 && skip_digits(text, 0) == text.size()) {
    std::int32_t value = 0;
    for (const char c : text) value = 10 * value + (c - '0');
    return value;
  }
  const auto d = std::ranges::find_if(text, [](char c) { return c == 'd' || c == 'D'; });
  if (d == text.end()) return convert(text);
  std::string with_e(text);
  with_e[static_cast<std::size_t>(d - text.begin())] = 'E';
  return convert(with_e);
}

}  // namespace dynalin

#include "nastran/cards.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "nastran/ids.h"

namespace dynalin::nastran {

namespace {

// d₀.d₁d₂… · 10^exponent, without zeros at the end.
struct Decimal {
  std::string digits;
  int exponent = 0;
  double value = 0;  // what a reader makes of it
};

// Rounded to so many digits; a carry is in it.
Decimal rounded(double magnitude, int digits) {
  std::array<char, 40> text;
  const char* end = fmt::format_to_n(text.data(), text.size(), "{:.{}e}", magnitude, digits - 1).out;
  Decimal d;
  const char* at = text.data();
  for (; *at != 'e'; ++at) {
    if (*at != '.') d.digits += *at;
  }
  std::from_chars(text.data(), end, d.value);
  at += at[1] == '+' ? 2 : 1;
  std::from_chars(at, end, d.exponent);
  while (d.digits.size() > 1 && d.digits.back() == '0') d.digits.pop_back();
  return d;
}

std::string with_point(const Decimal& d, std::size_t before) {
  std::string text = d.digits;
  if (text.size() < before) text.append(before - text.size(), '0');
  return text.insert(before, 1, '.');
}

std::string fixed(const Decimal& d, Exponent exponent) {
  std::string text = d.exponent >= 0 ? with_point(d, static_cast<std::size_t>(d.exponent) + 1)
                                     : "." + std::string(static_cast<std::size_t>(-d.exponent - 1), '0') + d.digits;
  return exponent == Exponent::letter_D ? text + "D0" : text;
}

// The point behind `before` digits.
std::string scientific(const Decimal& d, std::size_t before, Exponent exponent) {
  const int power = d.exponent + 1 - static_cast<int>(before);
  return with_point(d, before) +
         (exponent == Exponent::letter_D ? fmt::format("D{}", power) : fmt::format("{:+}", power));
}

class RealWriter {
 public:
  RealWriter(double magnitude, std::size_t columns, Exponent exponent)
      : magnitude_(magnitude),
        columns_(columns),
        exponent_(exponent),
        most_(static_cast<int>(columns) - (exponent == Exponent::letter_D ? 3 : 1)) {}

  std::string best() {
    const int e = at(most_).exponent;
    if (e + 2 <= static_cast<int>(columns_) && -e < static_cast<int>(columns_))
      offer([&](const Decimal& d) { return fixed(d, exponent_); }, true);
    offer([&](const Decimal& d) { return scientific(d, 1, exponent_); }, true);
    // The point elsewhere may save a digit of the exponent; that is unusual enough to be worth a digit only.
    if (e <= -10) offer([&](const Decimal& d) { return scientific(d, 0, exponent_); }, false);
    if (e >= 10) offer([&](const Decimal& d) { return scientific(d, d.digits.size(), exponent_); }, false);
    return best_;
  }

 private:
  const Decimal& at(int digits) {
    Decimal& d = decimals_[static_cast<std::size_t>(digits)];
    if (d.digits.empty()) d = rounded(magnitude_, digits);
    return d;
  }
  // The most digits of this form that fit.
  template <class Form>
  void offer(const Form& form, bool shorter_counts) {
    for (int n = most_; n > 0; --n) {
      const Decimal& d = at(n);
      std::string text = form(d);
      if (text.size() > columns_) continue;
      const double error = std::abs(d.value - magnitude_);
      if (best_.empty() || error < error_ || (shorter_counts && error == error_ && text.size() < best_.size())) {
        best_ = std::move(text);
        error_ = error;
      }
      return;
    }
  }

  double magnitude_;
  std::size_t columns_;
  Exponent exponent_;
  int most_;                          // digits beside a point, and D0 where it must be
  std::array<Decimal, 16> decimals_;  // by digits
  std::string best_;
  double error_ = 0;
};

}  // namespace

std::string real_text(double value, FieldWidth width, Exponent exponent) {
  if (!std::isfinite(value)) return {};
  const double magnitude = std::abs(value);
  const bool single = exponent == Exponent::bare;
  if (single && magnitude > static_cast<double>(std::numeric_limits<float>::max())) return {};
  if (magnitude == 0 || (single && magnitude < static_cast<double>(std::numeric_limits<float>::min())))
    return single ? "0." : "0.D0";
  const std::size_t sign = value < 0 ? 1 : 0;
  const std::string text = RealWriter(magnitude, static_cast<std::size_t>(width) - sign, exponent).best();
  return sign ? "-" + text : text;
}

Card& Card::integer(std::int64_t value) {
  if (value > Ids::largest || value < -Ids::largest / 10) {
    problem_ = fmt::format("the number {} does not fit into eight columns", value);
    has_wide_number_ = true;
  }
  fields_.push_back(std::to_string(value));
  return *this;
}

Card& Card::real(double value, Exponent exponent) {
  fields_.push_back(real_text(value, width_, exponent));
  if (fields_.back().empty())
    problem_ =
        std::isfinite(value) ? fmt::format("the value {} is beyond single precision", value) : "a value is not finite";
  return *this;
}

Card& Card::word(std::string_view text) {
  if (text.size() > 8) problem_ = fmt::format("the name {} is longer than eight characters", text);
  fields_.emplace_back(text);
  return *this;
}

Card& Card::blank(std::size_t count) {
  fields_.resize(fields_.size() + count);
  return *this;
}

void Card::append_line(std::string& text, std::string_view begin, std::size_t first, std::size_t count) const {
  std::size_t column = begin.size(), wanted = 8;
  text += begin;
  for (std::size_t k = first; k < first + count; ++k, wanted += static_cast<std::size_t>(width_)) {
    if (k >= fields_.size() || fields_[k].empty()) continue;
    // One that is too wide, which problem() tells, reaches into the next.
    if (column < wanted) text.append(wanted - column, ' ');
    text += fields_[k];
    column = std::max(column, wanted) + fields_[k].size();
  }
  text += '\n';
}

void Card::append_to(std::string& text) const {
  const bool large = width_ == FieldWidth::large;
  std::string begin(name_);
  if (large) begin += '*';
  for (std::size_t first = 0; first == 0 || first < fields_.size(); first += 8) {
    append_line(text, begin, first, large ? 4 : 8);
    if (large) append_line(text, "*", first + 4, 4);
    begin = large ? "*" : "+";
  }
}

std::string parameter_card(std::string_view name, std::string_view value) {
  return fmt::format("PARAM,{},{}\n", name, value);
}

}  // namespace dynalin::nastran

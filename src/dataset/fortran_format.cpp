#include "dataset/fortran_format.h"

#include <algorithm>

#include "dataset/characters.h"

namespace dynalin {

namespace {

constexpr std::size_t most_items = 10'000;  // stops repetitions of repetitions
constexpr std::size_t widest_field = 10'000;
constexpr int deepest_group = 20;
constexpr std::size_t largest_power = 99;

class FormatParser {
 public:
  explicit FormatParser(std::string_view text) : text_(text) {}

  std::optional<FortranFormat> parse() {
    if (!take('(') || !group(0)) return std::nullopt;
    const auto is_number = [](const FortranItem& i) { return i.is_number(); };
    if (std::ranges::none_of(format_.items, is_number)) return std::nullopt;
    // A last group without numbers would never end.
    const auto again = format_.items.begin() + static_cast<std::ptrdiff_t>(format_.again);
    if (std::none_of(again, format_.items.end(), is_number)) format_.again = 0;
    return format_;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  bool take(char c) {
    skip_blanks();
    if (at_ == text_.size() || to_upper(text_[at_]) != c) return false;
    ++at_;
    return true;
  }
  std::optional<std::size_t> take_count() {
    skip_blanks();
    if (at_ == text_.size() || !is_digit(text_[at_])) return std::nullopt;
    std::size_t value = 0;
    for (; at_ < text_.size() && is_digit(text_[at_]); ++at_) {
      value = std::min(10 * value + static_cast<std::size_t>(text_[at_] - '0'), widest_field + 1);
    }
    return value;
  }

  // Behind an opening parenthesis, up to and including the closing one.
  bool group(int depth) {
    if (depth > deepest_group) return false;
    while (!take(')')) {
      if (take(',')) continue;
      if (!item(depth)) return false;
      if (format_.items.size() > most_items) return false;
    }
    return true;
  }

  bool item(int depth) {
    const bool negative = take('-'), sign = negative || take('+');
    const std::optional<std::size_t> count = take_count();
    const std::size_t repeat = count.value_or(1);
    if (count && take('P')) return scale(*count, negative);
    if (sign) return false;
    if (take('/')) return append(repeat, {.kind = FortranItem::Kind::next_record});
    if (take('X')) return append(1, {.kind = FortranItem::Kind::skip, .width = repeat});
    if (take('(')) {
      const std::size_t begin = format_.items.size();
      if (depth == 0) format_.again = begin;
      return group(depth + 1) && repeat_from(begin, repeat);
    }
    return number(repeat);
  }

  bool scale(std::size_t power, bool negative) {
    if (power > largest_power) return false;
    const int p = static_cast<int>(power);
    return append(1, {.kind = FortranItem::Kind::scale, .power = negative ? -p : p});
  }

  bool number(std::size_t repeat) {
    const bool whole = take('I'), fixed = !whole && take('F');
    if (!whole && !fixed && !take('E') && !take('D') && !take('G')) return false;
    const std::optional<std::size_t> width = take_count();
    if (!width || *width == 0 || *width > widest_field) return false;
    std::size_t decimals = 0;
    if (take('.')) {
      const std::optional<std::size_t> digits = take_count();
      if (!digits) return false;
      decimals = whole ? 0 : *digits;
    }
    if (take('E') && !take_count()) return false;  // width of the exponent: E25.17E3
    const auto kind = whole ? FortranItem::Kind::whole_number : FortranItem::Kind::number;
    return append(repeat, {.kind = kind, .width = *width, .decimals = decimals, .fixed = fixed});
  }

  bool append(std::size_t repeat, const FortranItem& item) {
    if (repeat > most_items) return false;
    format_.items.insert(format_.items.end(), repeat, item);
    return true;
  }

  bool repeat_from(std::size_t begin, std::size_t repeat) {
    const std::vector<FortranItem> once(format_.items.begin() + static_cast<std::ptrdiff_t>(begin),
                                        format_.items.end());
    if (repeat == 0 || once.size() * repeat > most_items) return false;
    for (std::size_t i = 1; i < repeat; ++i) {
      format_.items.insert(format_.items.end(), once.begin(), once.end());
    }
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  FortranFormat format_;
};

}  // namespace

std::optional<FortranFormat> parse_fortran_format(std::string_view text) { return FormatParser(text).parse(); }

}  // namespace dynalin

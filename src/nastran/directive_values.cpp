#include "nastran/directive_values.h"

#include <fmt/format.h>

#include <charconv>
#include <numbers>

#include "base/enumeration.h"
#include "dataset/characters.h"
#include "dataset/dataset.h"
#include "dataset/number.h"

namespace dynalin::nastran {

namespace {

Span part(const Span& of, std::size_t begin, std::size_t end) {
  const std::string_view text = of.text();
  while (begin < end && is_blank(text[begin])) ++begin;
  while (end > begin && is_blank(text[end - 1])) --end;
  return {of.source, of.offset + static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)};
}

// A number with a sign perhaps, and what stands behind it.
std::optional<double> real_at_start(std::string_view text, std::string_view& rest) {
  const bool signed_text = !text.empty() && (text[0] == '+' || text[0] == '-');
  const std::string_view magnitude = text.substr(signed_text ? 1 : 0);
  const std::size_t length = number_extent(magnitude, ExponentLetter::e).length;
  if (length == 0) return std::nullopt;
  rest = magnitude.substr(length);
  const double value = number_value(magnitude.substr(0, length));
  return text[0] == '-' ? -value : value;
}

constexpr std::int64_t largest_integer = 99'999'999;

}  // namespace

void ValuePlace::error(const Span& at, std::string message, std::string hint) const {
  diagnostics.error("directive-value", at, std::move(message), std::move(hint));
}

std::vector<Span> split_list(const Span& list) {
  std::vector<Span> parts;
  const std::string_view text = list.text();
  for (std::size_t begin = 0;;) {
    const std::size_t comma = text.find(',', begin);
    parts.push_back(part(list, begin, std::min(comma, text.size())));
    if (comma == std::string_view::npos) return parts;
    begin = comma + 1;
  }
}

std::optional<std::int64_t> read_integer(const Span& at, const ValuePlace& place) {
  const std::string_view text = at.text();
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  std::int64_t value = 0;
  const auto [end, failed] = std::from_chars(begin, text.data() + text.size(), value);
  if (failed == std::errc::result_out_of_range || value > largest_integer || value < -largest_integer) {
    place.error(at, fmt::format("{} is at most {}, not {}", place.name, largest_integer, text));
    return std::nullopt;
  }
  if (failed != std::errc() || end != text.data() + text.size() ||
      (begin != text.data() && text.size() > 1 && text[1] == '-')) {
    place.error(at, fmt::format("{} takes an integer, not \"{}\"", place.name, text));
    return std::nullopt;
  }
  return value;
}

std::optional<double> read_real(const Span& at, const ValuePlace& place) {
  std::string_view rest;
  const auto value = real_at_start(at.text(), rest);
  if (value && rest.empty()) return value;
  const bool degrees = value && (rest[0] == 'D' || rest[0] == 'd');
  place.error(at, fmt::format("{} takes a number, not \"{}\"", place.name, at.text()),
              degrees ? "D means degrees, of angles alone; an exponent is written with E" : "");
  return std::nullopt;
}

std::optional<double> read_angle(const Span& at, const ValuePlace& place) {
  std::string_view rest;
  const auto value = real_at_start(at.text(), rest);
  if (value && rest.empty()) return value;
  if (value && (rest == "D" || rest == "d")) return *value * std::numbers::pi / 180;
  place.error(at, fmt::format("{} takes an angle in radians, or in degrees with a D behind it, not \"{}\"", place.name,
                              at.text()));
  return std::nullopt;
}

std::optional<std::size_t> read_choice(const Span& at, std::span<const std::string_view> words,
                                       const ValuePlace& place) {
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (words[k] == at.text()) return k;
  }
  const std::string_view near = nearest_word(at.text(), words);
  place.error(at, fmt::format("{} is {}, not \"{}\"", place.name, enumeration(words, "or"), at.text()),
              near.empty() ? "" : fmt::format("{} = {}", place.name, near));
  return std::nullopt;
}

std::optional<std::vector<std::string>> read_names(const Span& at, const ValuePlace& place) {
  std::vector<std::string> names;
  for (const Span& name : split_list(at)) {
    names.push_back(read_string(name));
    if (!names.back().empty()) continue;
    place.error(at, fmt::format("{} takes names with commas between them, and one is empty", place.name));
    return std::nullopt;
  }
  return names;
}

std::optional<std::vector<IdRange>> read_ranges(const Span& at, const ValuePlace& place) {
  std::vector<IdRange> ranges;
  for (const Span& written : split_list(at)) {
    const std::size_t dash = written.text().find('-', 1);
    const bool range = dash != std::string_view::npos;
    const auto first = read_integer(range ? part(written, 0, dash) : written, place);
    const auto last = range && first ? read_integer(part(written, dash + 1, written.length), place) : first;
    if (!first || !last) return std::nullopt;
    if (*first < 1 || *last < *first) {
      place.error(written,
                  fmt::format("{} takes ids from 1 on and ranges upwards, not \"{}\"", place.name, written.text()));
      return std::nullopt;
    }
    ranges.push_back({*first, *last});
  }
  return ranges;
}

std::optional<ClanRegion> read_region(const Span& at, const ValuePlace& place) {
  const std::vector<Span> parts = split_list(at);
  ClanRegion region;
  if (parts.size() != region.values.size() + 1) {
    place.error(at, fmt::format("{} takes five reals and an integer, {} values are there", place.name, parts.size()));
    return std::nullopt;
  }
  for (std::size_t k = 0; k < region.values.size(); ++k) {
    const auto value = read_real(parts[k], place);
    if (!value) return std::nullopt;
    region.values[k] = *value;
  }
  const auto count = read_integer(parts.back(), place);
  if (!count) return std::nullopt;
  if (*count < 1) {
    place.error(parts.back(), fmt::format("{} ends with the number of eigenvalues, at least 1", place.name));
    return std::nullopt;
  }
  region.count = *count;
  return region;
}

std::string read_string(const Span& at) {
  std::string_view text = at.text();
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return std::string(text);
}

}  // namespace dynalin::nastran

// Names as a sentence has them: "A, B and C".
#pragma once

#include <fmt/ranges.h>

#include <iterator>
#include <string>
#include <string_view>

namespace dynalin {

// `last_word` stands between the last two.
template <class Names>
std::string enumeration(const Names& names, std::string_view last_word = "and") {
  const auto begin = std::begin(names), end = std::end(names);
  if (begin == end) return {};
  const auto last = std::prev(end);
  if (begin == last) return fmt::format("{}", *last);
  return fmt::format("{} {} {}", fmt::join(begin, last, ", "), last_word, *last);
}

}  // namespace dynalin

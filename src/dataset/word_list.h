// Lists of words as tables state them: "ZG XG".
#pragma once

#include <algorithm>
#include <string_view>

namespace dynalin {

// Whether a list of words with blanks between them has this one.
constexpr bool lists_word(std::string_view list, std::string_view word) {
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(' ', begin), list.size());
    if (list.substr(begin, end - begin) == word) return true;
    begin = end + 1;
  }
  return false;
}

}  // namespace dynalin

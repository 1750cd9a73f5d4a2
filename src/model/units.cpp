#include "dynalin/units.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace dynalin {

std::string Units::time_symbol() const {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> symbols = {{{"SECOND", "s"},
                                                                                            {"MILLISECONDS", "ms"},
                                                                                            {"MICROSECOND", "us"},
                                                                                            {"NANOSECOND", "ns"},
                                                                                            {"MINUTE", "min"},
                                                                                            {"HOUR", "h"},
                                                                                            {"DAY", "day"}}};
  const auto found = std::find_if(symbols.begin(), symbols.end(), [&](const auto& s) { return s.first == time; });
  return std::string(found == symbols.end() ? "time" : found->second);
}

}  // namespace dynalin

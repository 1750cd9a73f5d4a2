// What LIST of a settings command shows, as the file of the command has it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dynalin {

struct Settings;

enum class Shown : std::uint8_t {
  text,      // as written
  number,    // 0.000100
  exponent,  //    1.000000e-05
  angle,     // 0.174533 (rad)
  pattern,   // TTTT
};
std::string shown_number(double, Shown);

// A setting is an argument with its value, or that one of several words which was stated last.
struct SettingRow {
  std::string_view label, words;  // blanks between the words
  std::string_view unstated;  // what holds where it is not stated, unless other settings say more (SettingList::held)
  Shown shown = Shown::text;
  bool is_limit = false;  // 0 is as if it were not stated (analysis/stated_limit.h)
};
inline constexpr std::string_view without_effect = "without effect";

using SettingLines = std::vector<std::pair<std::string, std::string>>;

// Without rows: whatever was stated.
struct SettingList {
  std::span<const SettingRow> rows = {};
  // What holds of a label where other arguments decide; nothing where they do not.
  std::optional<std::string> (*held)(std::string_view label, bool stated, const Settings&) = nullptr;
  // Rows that there are for some settings only.
  SettingLines (*more)(const Settings&) = nullptr;
  std::span<const std::string_view> shorthands = {};  // statements that say the same in short, with a word of their own
};

}  // namespace dynalin

#include "dataset/raw_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "dataset/characters.h"

namespace dynalin {

namespace {

struct RawArgument {
  std::string_view statement;  // "" for every statement
  std::string_view full;
  std::size_t minimum;  // letters that are enough
  ValueForm form = ValueForm::text;
};

constexpr auto raw_arguments = std::to_array<RawArgument>({
    {"", "FILE", 3},
    {"", "MNF_FILE", 3},
    {"", "DB_FILE", 4},
    {"", "BDF_FILE", 4},
    {"GSE", "ROUTINE", 4, ValueForm::text_list},
    {"GSE", "INTERFACE", 6, ValueForm::text_list},
    {"COUPLER", "ROUTINE", 4, ValueForm::text_list},
    {"CONTACT", "NROUTINE", 4},
    {"CONTACT", "FROUTINE", 4},
    {"", "ROUTINE", 4},
    {"", "INTERFACE", 6},
    {"", "LABEL", 3},
    {"", "TITLE", 3},
    {"", "CONFIG_FILE", 4},
    {"MATRIX", "NAME", 1},
    {"MATRIX", "FILE", 2},
    {"MATERIAL", "NAME", 1},
    {"STRING", "STRING", 1, ValueForm::free_text},
    {"PART", "MATERIAL", 3},
    {"POINT_MASS", "MATERIAL", 3},
    {"GRAPHICS", "ELEMENT", 2},
    {"SPLINE", "BLOCK", 1},
    {"REQUEST", "COMMENT", 1, ValueForm::rest_of_line},
    {"REQUEST", "TITLE", 1},
    {"REQUEST", "CNAMES", 2, ValueForm::text_list},
    {"REQUEST", "CUNITS", 2, ValueForm::text_list},
    {"REQUEST", "CLABELS", 2, ValueForm::text_list},
    {"REQUEST", "RESULTS_NAME", 3},
    {"MREQUEST", "COMMENT", 1, ValueForm::rest_of_line},
    {"RESULTS", "COMMENT", 1, ValueForm::rest_of_line},
    {"FILE", "MODEL", 1},
    {"FILE", "COMMAND", 1},
    {"FILE", "OUTPUT_PREFIX", 3},
    {"SAVE", "FILE", 1},
    {"SAVE", "TITLE", 1},
    {"RELOAD", "FILE", 1},
    {"RELOAD", "TITLE", 1},
    {"RELOAD", "OUTPUT_PREFIX", 3},
    {"LINEAR", "FILE", 2},
    {"LINEAR", "CONFIG", 3},
    {"ENVIRONMENT", "NAME", 1},
    {"ENVIRONMENT", "VALUE", 1},
    {"PREFERENCES", "LIBPATH", 3},
    {"PREFERENCES", "CONTACT_GEOMETRY_LIBRARY", 9},
});

// Which rows begin with a letter, a bit each: every argument of a dataset is looked for, and few are here.
constexpr auto rows_of_letter = [] {
  std::array<std::uint64_t, 256> rows{};
  static_assert(raw_arguments.size() <= 64);
  for (std::size_t k = 0; k < raw_arguments.size(); ++k)
    rows[static_cast<unsigned char>(raw_arguments[k].full.front())] |= std::uint64_t{1} << k;
  return rows;
}();

constexpr auto after_comment =
    std::to_array<std::string_view>({"I", "J", "RM", "F1", "F2", "F3", "F4", "F5", "F6", "F7", "F8", "FUNCTION",
                                     "TITLE", "CNAMES", "CUNITS", "CLABELS", "RESULTS_NAME", "VARIABLES"});

struct Follower {
  std::string_view statement, name;
};
constexpr auto after_text_list = std::to_array<Follower>({{"REQUEST", "DISPLACEMENT"},
                                                          {"REQUEST", "VELOCITY"},
                                                          {"REQUEST", "ACCELERATION"},
                                                          {"REQUEST", "FORCE"},
                                                          {"GSE", "IMPLICIT"},
                                                          {"GSE", "STATIC_HOLD"},
                                                          {"GSE", "STATICS_ONLY"}});

}  // namespace

ValueForm value_form(std::string_view statement, std::string_view argument) {
  if (argument.empty()) return ValueForm::tokens;
  const char first = to_upper(argument.front());
  for (std::uint64_t rows = rows_of_letter[static_cast<unsigned char>(first)]; rows != 0; rows &= rows - 1) {
    const RawArgument& raw = raw_arguments[static_cast<std::size_t>(std::countr_zero(rows))];
    if (argument.size() < raw.minimum || !begins_with_ignoring_case(raw.full, argument)) continue;
    if (raw.statement.empty() || raw.statement == statement) return raw.form;
  }
  return ValueForm::tokens;
}

// Fewer letters are rather one of the texts.
bool ends_text_list(std::string_view statement, std::string_view word) {
  constexpr std::size_t enough = 4;
  return word.size() >= enough && std::any_of(after_text_list.begin(), after_text_list.end(), [&](const Follower& f) {
           return f.statement == statement && begins_with_ignoring_case(f.name, word);
         });
}

bool ends_comment(std::string_view name) {
  return std::any_of(after_comment.begin(), after_comment.end(),
                     [&](std::string_view word) { return equal_ignoring_case(word, name); });
}

}  // namespace dynalin

// The words that arguments of FRICTION take, and what each stands for.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "elements/forces/friction_law.h"
#include "model/reader.h"

namespace dynalin {

// What presses the surfaces together, as INPUTS has it.
enum class FrictionInput : std::uint8_t { all, none, preload, force, bending, torsion };
// How the overlap goes with displacement along z of J.
enum class OverlapChange : std::uint8_t { none, increase, decrease };
// Analyses in which there is no friction.
enum class FrictionRests : std::uint8_t { in_statics };

namespace friction_words {

template <class Choice>
struct Word {
  std::string_view name;
  Choice choice;
  bool alone = false;  // no other beside it
};

inline constexpr std::array<Word<FrictionEffect>, 3> effects = {
    {{"ALL", FrictionEffect::all, true}, {"STICTION", FrictionEffect::stiction}, {"SLIDING", FrictionEffect::sliding}}};
inline constexpr std::array<Word<FrictionInput>, 6> inputs = {{{"ALL", FrictionInput::all, true},
                                                               {"NONE", FrictionInput::none, true},
                                                               {"PRELOAD", FrictionInput::preload},
                                                               {"REACTION_FORCE", FrictionInput::force},
                                                               {"BENDING_MOMENT", FrictionInput::bending},
                                                               {"TORSIONAL_MOMENT", FrictionInput::torsion}}};
inline constexpr std::array<Word<OverlapChange>, 3> overlaps = {
    {{"CONSTANT", OverlapChange::none}, {"INCREASE", OverlapChange::increase}, {"DECREASE", OverlapChange::decrease}}};
inline constexpr std::array<Word<FrictionRests>, 1> rests = {{{"STATIC", FrictionRests::in_statics}}};
inline constexpr std::array<Word<FrictionFormulation>, 2> formulations = {
    {{"ORIGINAL", FrictionFormulation::stick_slip}, {"LUGRE", FrictionFormulation::lugre}}};

// The word that each written one begins; nothing after a reported one that begins none, or stands beside others and
// must not.
template <class Choice, std::size_t n>
std::optional<std::vector<Word<Choice>>> read(const std::vector<std::string>& written,
                                              const std::array<Word<Choice>, n>& words, std::string_view argument,
                                              ElementReader& reader) {
  std::vector<Word<Choice>> found;
  for (const std::string& w : written) {
    const auto begun = [&](const Word<Choice>& word) { return !w.empty() && word.name.starts_with(w); };
    const auto at = std::find_if(words.begin(), words.end(), begun);
    if (at == words.end()) {
      std::vector<std::string_view> names;
      for (const Word<Choice>& word : words) names.push_back(word.name);
      reader.error(
          "unknown-word", reader.at(argument),
          fmt::format("{} of {} takes {}, not {}", argument, reader.label().text(), fmt::join(names, ", "), w));
      return std::nullopt;
    }
    found.push_back(*at);
  }
  const auto lonely = std::ranges::find(found, true, &Word<Choice>::alone);
  if (found.size() > 1 && lonely != found.end()) {
    reader.error("excluded-arguments", reader.at(argument),
                 fmt::format("{} stands alone in {} of {}", lonely->name, argument, reader.label().text()));
    return std::nullopt;
  }
  return found;
}

template <class Choice>
bool among(const std::vector<Word<Choice>>& words, Choice choice) {
  return std::ranges::find(words, choice, &Word<Choice>::choice) != words.end();
}

}  // namespace friction_words

}  // namespace dynalin

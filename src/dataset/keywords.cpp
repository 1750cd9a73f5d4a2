// Keyword lookup: exact match, unique prefix, documented short forms; and the nearest word for
// hints.
#include <algorithm>
#include <array>
#include <numeric>

#include "dataset/characters.h"
#include "dataset/dataset.h"

namespace dynalin {

namespace {

// A documented short form that is no unique prefix: from `minimum` on, every beginning of `full`
// means it. Where several rows fit, the first whose full word is among the candidates counts.
struct ShortForm {
  std::string_view minimum, full;
};
constexpr auto short_forms = std::to_array<ShortForm>({
    // statements
    {"M", "MARKER"},
    {"P", "PART"},
    {"J", "JOINT"},
    {"R", "REQUEST"},
    {"LS", "LSOLVER"},
    {"ST", "STRING"},
    {"SE", "SENSOR"},
    {"CON", "CONTACT"},
    {"DE", "DEBUG"},
    // arguments
    {"M", "MASS"},
    {"C", "COMMENT"},
    {"D", "DISPLACEMENT"},
    {"V", "VELOCITY"},
    {"A", "ACCELERATION"},
    {"F", "FORCE"},
    {"L", "LENGTH"},
    {"R", "RADIUS"},
    {"R", "REULER"},
    {"R", "ROWS"},
    {"MAX", "MAXIT"},
    {"ST", "STABILITY"},
    {"C", "COLUMNS"},
    {"FLE", "FLEX_BODY"},
    {"A", "ACTIONONLY"},
    {"D", "DISSIPAT"},
    {"CR", "CRATIO"},
    // kinds of joints
    {"C", "CYLINDRICAL"},
    {"T", "TRANSLATIONAL"},
    {"U", "UNIVERSAL"},
});

// Words that are met with more letters than the keyword has.
constexpr auto longer_spellings = std::to_array<ShortForm>({
    {"EIGENSOL", "EIGENSOLUTION"},
    {"NODAMPIN", "NODAMPING"},
    {"NOVECTOR", "NOVECTORS"},
    {"STATEMAT", "STATEMATRICES"},
    {"STATEMAT", "STATEMATRIX"},
    {"DISSIPAT", "DISSIPATION"},
});

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Two rows of the usual table; a swap of neighbours counts as one edit.
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = to_upper(a[i - 1]) == to_upper(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && to_upper(a[i - 1]) == to_upper(b[j - 2]) && to_upper(a[i - 2]) == to_upper(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last[b.size()];
}

}  // namespace

std::optional<std::size_t> find_keyword(std::string_view word, std::span<const std::string_view> candidates,
                                        std::vector<std::string_view>* ambiguous) {
  if (ambiguous) ambiguous->clear();
  if (word.empty()) return std::nullopt;
  std::optional<std::size_t> first;
  std::size_t count = 0;
  const char letter = to_upper(word.front());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    // Most are passed over by their first letter: every argument of a dataset is looked up here.
    if (candidates[i].empty() || to_upper(candidates[i].front()) != letter) continue;
    if (!begins_with_ignoring_case(candidates[i], word)) continue;
    if (candidates[i].size() == word.size()) return i;
    if (!first) first = i;
    ++count;
  }
  if (count == 1) return first;
  if (count == 0) {
    for (const ShortForm& form : longer_spellings) {
      if (!begins_with_ignoring_case(word, form.minimum) || !begins_with_ignoring_case(form.full, word)) continue;
      const auto found = std::find(candidates.begin(), candidates.end(), form.minimum);
      if (found != candidates.end()) return static_cast<std::size_t>(found - candidates.begin());
    }
    return std::nullopt;
  }

  for (const ShortForm& form : short_forms) {
    if (!begins_with_ignoring_case(word, form.minimum)) continue;
    if (!begins_with_ignoring_case(form.full, word)) continue;
    const auto found = std::find(candidates.begin(), candidates.end(), form.full);
    if (found != candidates.end()) return static_cast<std::size_t>(found - candidates.begin());
  }
  if (ambiguous) {
    for (const std::string_view candidate : candidates) {
      if (begins_with_ignoring_case(candidate, word)) ambiguous->push_back(candidate);
    }
  }
  return std::nullopt;
}

std::string_view statement_name(std::string_view word) {
  const std::span<const std::string_view> names = statement_names();
  const std::optional<std::size_t> found = find_keyword(word, names);
  return found ? names[*found] : std::string_view{};
}

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates) {
  constexpr std::size_t longest = 40;  // longer words are no misspelt keywords
  if (word.empty() || word.size() > longest) return {};
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > word.size() + best_distance) continue;
    if (word.size() > candidate.size() + best_distance) continue;
    const std::size_t distance = edit_distance(word, candidate);
    // Of two equally near ones a word that was left unfinished.
    const bool finishes = distance == best_distance && !best.empty() && begins_with_ignoring_case(candidate, word) &&
                          !begins_with_ignoring_case(best, word);
    if ((distance < best_distance || finishes) && distance < candidate.size()) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace dynalin

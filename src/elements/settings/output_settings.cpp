#include "elements/settings/output_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dataset/characters.h"
#include "elements/settings/setting_set.h"

namespace dynalin {

namespace {

template <class E, class Use>
void for_each_statement(const Model& model, const Use& use) {
  for (const auto& set : model.sets) {
    if (const auto* typed = dynamic_cast<const TypedSet<E>*>(set.get())) {
      for (const E& e : typed->elements) use(e);
    }
  }
}

}  // namespace

bool WrittenOutput::check(ElementReader& reader) const {
  bool ok = true;
  for (const auto& [factors, name] : {std::pair{&dscale, "DSCALE"}, std::pair{&vscale, "VSCALE"},
                                      std::pair{&ascale, "ASCALE"}, std::pair{&fscale, "FSCALE"}}) {
    if (factors->size() <= 2) continue;
    reader.error("wrong-count", reader.at(name),
                 fmt::format("{} takes one factor, or one of translations and one of rotations, found {}", name,
                             factors->size()));
    ok = false;
  }
  return ok;
}

bool WrittenResults::check(ElementReader& reader) const {
  // The rest of the line is the comment, and what looks like an argument there asks for nothing.
  constexpr std::size_t enough = 3;
  std::vector<std::string> words;
  for (std::size_t comma = comment.find(','); comma != std::string::npos; comma = comment.find(',', comma + 1)) {
    std::string_view word = std::string_view(comment).substr(comma + 1);
    word = word.substr(0, word.find(','));
    while (!word.empty() && is_blank(word.front())) word.remove_prefix(1);
    while (!word.empty() && is_blank(word.back())) word.remove_suffix(1);
    if (word.size() >= enough && find_keyword(word, detail::argument_names<WrittenResults>))
      words.push_back(upper_case(word));
  }
  if (words.empty()) return true;
  const std::string list = fmt::format("{}", fmt::join(words, ", "));
  reader.warning("passed-over", reader.at("COMMENT"),
                 fmt::format("COMMENT takes the rest of its line, and {} in it {} for nothing", list,
                             words.size() == 1 ? "asks" : "ask"),
                 fmt::format("RESULTS/{}, COMMENT=…", list));
  return true;
}

void WrittenResults::remark(std::span<const WrittenResults> all, std::span<const ElementLabel> labels,
                            Diagnostics& diagnostics) {
  if (all.empty() || std::ranges::any_of(all, &WrittenResults::xrf)) return;
  diagnostics.warning("passed-over", labels.back().at, "no results file is written, as RESULTS does not say XRF",
                      "RESULTS/XRF");
}

void WrittenOutput::apply(OutputSettings& s) const {
  if (defaults) s = {};
  // LIST alone asks for nothing, and DEFAULT for what is without an OUTPUT.
  s.stated = s.stated || requests || graphics || print || fixed || yaw_pitch_roll || !(list || defaults);
  if (requests || no_requests) s.request_file = requests;
  if (graphics || no_graphics) s.graphics_file = graphics;
  if (print || no_print) s.tables = print;
  s.fixed = s.fixed || fixed;
  if (yaw_pitch_roll || euler) s.yaw_pitch_roll = yaw_pitch_roll;
  const std::array scales = {&dscale, &vscale, &ascale, &fscale};
  const std::array zeros = {&dzero, &vzero, &azero, &fzero};
  for (std::size_t k = 0; k < scales.size(); ++k) {
    std::copy(scales[k]->begin(), scales[k]->end(), s.scale[k].begin());
    if (*zeros[k]) s.zero[k] = **zeros[k];
  }
}

OutputSettings output_settings(const Model& model) {
  OutputSettings s;
  for_each_statement<WrittenOutput>(model, [&](const WrittenOutput& o) { o.apply(s); });
  return s;
}

ResultsContents results_contents(const Model& model) {
  ResultsContents c{model.settings.results, true, {}};
  for_each_statement<WrittenResults>(model, [&](const WrittenResults& r) {
    c.requests = c.requests && !r.no_requests;
    if (!r.comment.empty()) c.comment = r.comment;
  });
  return c;
}

extern constinit const Kind output = setting<WrittenOutput>("OUTPUT", "What is written to which file.");
extern constinit const Kind results = setting<WrittenResults>("RESULTS", "Contents of the results file.");

}  // namespace dynalin

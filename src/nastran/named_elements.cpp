#include "nastran/named_elements.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "base/diagnostics.h"
#include "dataset/characters.h"
#include "model/view_names.h"

namespace dynalin::nastran {

namespace {

struct Candidate {
  const ElementLabel* label;
  std::string path;          // without the dot that View begins it with
  std::string without_part;  // that of a marker, model.cm
};

Candidate candidate(const ElementLabel& label, std::string path, std::string without_part) {
  for (std::string* text : {&path, &without_part}) {
    if (text->starts_with('.')) text->erase(0, 1);
  }
  return {&label, std::move(path), std::move(without_part)};
}

bool has_end(std::string_view path, std::string_view end) {
  return path.ends_with(end) && (path.size() == end.size() || path[path.size() - end.size() - 1] == '.');
}

// The one that is meant. A path that begins with a dot is whole, and so is one that is written out.
Named<std::size_t> chosen(const std::vector<Candidate>& all, std::string_view name, std::string_view kind) {
  const bool whole = name.starts_with('.');
  const std::string_view wanted = whole ? name.substr(1) : name;
  std::vector<std::size_t> found, written_out;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Candidate& c = all[k];
    if (c.path == wanted && (whole || c.path != c.label->view_name)) written_out.push_back(k);
    if (whole ? c.path == wanted : has_end(c.path, wanted) || c.without_part == wanted) found.push_back(k);
  }
  if (written_out.size() == 1) return written_out.front();
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    std::vector<std::string_view> names;
    for (const Candidate& c : all) {
      names.push_back(c.label->view_name);
      names.emplace_back(c.path);
    }
    const std::string_view near = nearest_word(name, names);
    return tl::unexpected(
        NameProblem{"unknown-element", fmt::format("no {} has the name {}", kind, name),
                    near.empty() ? "names are those of adams_view_name comments" : fmt::format("{} exists", near)});
  }
  constexpr std::size_t most = 10;
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < std::min(most, found.size()); ++k) {
    const Candidate& c = all[found[k]];
    texts.push_back(fmt::format("{} ({})", c.path, c.label->text()));
  }
  if (found.size() > most) texts.push_back(fmt::format("{} more", found.size() - most));
  return tl::unexpected(NameProblem{"ambiguous-name",
                                    fmt::format("{} is the name of {}: {}", name, found.size(), fmt::join(texts, ", ")),
                                    "more of its path, or the directive with an id, tells one from the others"});
}

}  // namespace

Named<MarkerId> marker_of_id(const Model& model, std::int64_t id) {
  const auto found = id > 0 ? model.find_marker(id) : std::nullopt;
  if (!found) return tl::unexpected(NameProblem{"unknown-element", fmt::format("MARKER/{} does not exist", id), {}});
  return *found;
}

Named<MarkerId> marker_of_name(const Model& model, std::string_view name) {
  std::vector<Candidate> all;
  std::vector<MarkerId> ids;
  const std::string_view of_model = view_model_name(model.title);
  for (std::int32_t k = 1; k < static_cast<std::int32_t>(model.markers.size()); ++k) {
    const Marker& m = model.marker({k});
    if (m.label->view_name.empty()) continue;
    all.push_back(candidate(*m.label, view_path(model, m), view_path(of_model, {}, m.label->view_name)));
    ids.push_back({k});
  }
  return chosen(all, name, "marker").map([&](std::size_t k) { return ids[k]; });
}

Named<const ElementLabel*> element_of_name(const Model& model, std::string_view statement, std::string_view name) {
  std::vector<Candidate> all;
  for (const auto& set : model.sets) {
    if (set->kind().statement != statement) continue;
    for (const ElementLabel& label : set->labels) {
      if (!label.view_name.empty()) all.push_back(candidate(label, view_path(model, label), view_path(model, label)));
    }
  }
  return chosen(all, name, statement).map([&](std::size_t k) { return all[k].label; });
}

Named<MarkerId> marker_of_channel(const Model& model, const ChannelMarker& at) {
  if (!at.marker_id) return marker_of_name(model, at.marker_name);
  const auto numbered = marker_of_id(model, *at.marker_id);
  if (!numbered || at.marker_name.empty()) return numbered;
  const auto named = marker_of_name(model, at.marker_name);
  if (!named || *named == *numbered) return named;
  return tl::unexpected(
      NameProblem{"two-markers",
                  fmt::format("marker_id is {}, and marker_name {} is {}", model.marker(*numbered).label->full_text(),
                              at.marker_name, model.marker(*named).label->full_text()),
                  "one of them is enough"});
}

}  // namespace dynalin::nastran

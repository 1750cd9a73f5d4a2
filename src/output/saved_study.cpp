#include "output/saved_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "base/read_file.h"

namespace dynalin {

namespace {

// "PART/2, PART/3 and 4 more"
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  const std::vector<std::string> first(names.begin(),
                                       names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size())));
  const std::string text = fmt::format("{}", fmt::join(first, ", "));
  return names.size() <= most ? text : fmt::format("{} and {} more", text, names.size() - most);
}

Diagnostics of_others(const RestoredPoint& restored, std::string_view name) {
  Diagnostics remarks;
  const auto say = [&](std::string text) { remarks.warning("reloaded-in-part", {}, std::move(text)); };
  if (!restored.not_here.empty())
    say(fmt::format("{} has values of {}, which the model does not have; they are left out", name,
                    listed(restored.not_here)));
  if (!restored.not_saved.empty())
    say(fmt::format("{} has no values of {}, which start as the model states them", name, listed(restored.not_saved)));
  if (!restored.others.empty())
    say(
        fmt::format("{} has other coordinates of {} than the model; they are not taken, and these start as the model "
                    "states them",
                    name, listed(restored.others)));
  return remarks;
}

}  // namespace

std::vector<SavedFile::Model::Further> files_of(const Model& model) {
  std::vector<SavedFile::Model::Further> files;
  for (const std::string& name : model.input_files) {
    const auto kept =
        std::ranges::find_if(model.further_sources, [&](const SourceRef& s) { return s->name() == name; });
    if (kept != model.further_sources.end()) {
      files.push_back({name, fingerprint((*kept)->text())});
    } else if (const auto text = read_file(name)) {
      files.push_back({name, fingerprint(*text)});
    }
  }
  return files;
}

std::string fingerprint_of(const Model& model, std::string_view dataset, std::vector<std::string> changes) {
  for (auto& file : files_of(model)) changes.push_back(std::move(file.fingerprint));
  return fingerprint(dataset, changes);
}

SavedFile saved_study(const StudyPoint& point, std::string fingerprint) {
  SavedFile saved;
  saved.model_title = point.system->model().title;
  saved.fingerprint = std::move(fingerprint);
  saved.started = point.started, saved.consistent = point.consistent;
  saved.restated = point.restated, saved.redundant_rows = point.redundant_rows;
  saved.point = saved_point(*point.system, point.values);
  if (point.statics)
    saved.statics = {point.statics->iterations, point.statics->imbalance,
                     saved_point(*point.system, point.statics->at_rest)};
  return saved;
}

ReloadedPoint reloaded(const SavedFile& saved, std::shared_ptr<const System> system, std::string_view fingerprint,
                       std::string_view name) {
  RestoredPoint restored = restored_point(saved.point, *system);
  ReloadedPoint result{{}, of_others(restored, name)};
  const bool whole = restored.not_here.empty() && restored.not_saved.empty() && restored.others.empty();
  StudyPoint& point = result.point;
  point.system = std::move(system);
  point.values = std::move(restored.point);
  point.started = saved.started;
  // In another model the same values need not agree with the constraints, and forces are others.
  point.consistent = saved.consistent && whole && saved.fingerprint == fingerprint;
  point.restated = saved.restated;
  point.restated.append(restored.begun);
  point.redundant_rows = saved.redundant_rows;
  if (saved.statics && point.consistent)
    point.statics = StaticSolution{saved.statics->iterations, saved.statics->imbalance,
                                   restored_point(saved.statics->at_rest, *point.system).point};
  return result;
}

}  // namespace dynalin

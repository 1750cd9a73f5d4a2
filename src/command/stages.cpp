#include "command/stages.h"

#include <fmt/format.h>

#include <algorithm>

#include "elements/catalogue.h"
#include "output/saved_study.h"

namespace dynalin {

void keep_texts(const Job::Stage& stage, std::vector<SourceRef>& texts) {
  texts.insert(texts.end(), stage.model->further_sources.begin(), stage.model->further_sources.end());
}

namespace {

// The model after some edits, and all that is wrong with them and with it.
Parsed<Job::Stage> after(const Job::Stage& from, std::span<const Command> edits, const SessionOptions& options) {
  Parsed<EditedDataset> edit;
  DatasetEditor editor(from.dataset, edits.front().written, catalogue(), edit.diagnostics);
  SharedChain<std::string> written = from.edits;
  for (const Command& c : edits) {
    c.action->edit(editor);
    written.add(std::string(c.whole.text()));
  }
  edit.value = std::move(editor).finish();
  auto made = edited_model(from, std::move(edit), model_options(options));
  return {{std::move(made.value), std::move(written)}, std::move(made.diagnostics)};
}

// The edit that has brought a problem about, as the model before all of them had none: the last of the fewest that have
// it too.
const Command& cause_of(const Diagnostic& d, const Job::Stage& from, std::span<const Command> edits,
                        const SessionOptions& options) {
  std::size_t without = 0, with = edits.size();
  while (with - without > 1) {
    const std::size_t half = without + (with - without) / 2;
    const auto fewer = after(from, edits.first(half), options);
    const bool has_it =
        std::ranges::any_of(fewer.diagnostics.items(), [&](const Diagnostic& f) { return f.message == d.message; });
    (has_it ? with : without) = half;
  }
  return edits[with - 1];
}

// A command of one argument is at fault by that.
Span place_in(const Command& c) {
  const auto& arguments = c.statement->arguments;
  if (arguments.size() != 1) return c.at;
  const WrittenArgument& w = arguments.front();
  return w.has_value && !w.value().empty() ? join(w.name, w.value_span()) : w.name;
}

}  // namespace

ModelOptions model_options(const SessionOptions& options) {
  return {options.user_value, {options.user_libraries, options.difference_user_routines}, options.pade};
}

std::optional<Job::Stage> stage_of_dataset(SourceRef source, const SessionOptions& options, Statements statements,
                                           std::vector<SourceRef>& texts, Diagnostics& diagnostics) {
  auto made = made_model(parse_dataset(std::move(source)), statements, model_options(options));
  Job::Stage stage{std::move(made.value), {}};
  keep_texts(stage, texts);
  const bool sound = !made.diagnostics.has_errors();
  diagnostics.append(std::move(made.diagnostics));
  return sound ? std::optional(std::move(stage)) : std::nullopt;
}

std::optional<Job::Stage> edited_stage(const Job::Stage& from, std::span<const Command> edits,
                                       const SessionOptions& options, std::vector<SourceRef>& texts,
                                       Diagnostics& diagnostics) {
  auto edited = after(from, edits, options);
  if (!edited.diagnostics.items().empty()) keep_texts(edited.value, texts);
  if (!edited.diagnostics.has_errors()) {
    diagnostics.append(std::move(edited.diagnostics));
    return std::move(edited.value);
  }
  for (const Diagnostic& d : edited.diagnostics.items()) {
    const bool at_edit = std::ranges::any_of(edits, [&](const Command& c) { return c.at.source == d.at.source; });
    if (d.severity != Severity::error || at_edit) {
      repeat(d, d.at, diagnostics);
      continue;
    }
    const Command& cause = cause_of(d, from, edits, options);
    Diagnostic& moved = repeat(d, place_in(cause), diagnostics);
    if (d.at.source) moved.notes.insert(moved.notes.begin(), {d.at, "what does not go with it stands here"});
  }
  return std::nullopt;
}

std::string fingerprint_of(const Job::Stage& stage) {
  return fingerprint_of(*stage.model, stage.dataset->source->text(), stage.edits.list());
}

std::optional<Job::Stage> saved_stage(const SavedFile::Model& saved, const std::string& name,
                                      const SessionOptions& options, std::vector<SourceRef>& texts,
                                      Diagnostics& diagnostics) {
  if (saved.pade != options.pade)
    diagnostics.warning("reloaded-in-part", {},
                        fmt::format("{} was saved {} --pade, and this run is {} it: DELAYs have other states", name,
                                    saved.pade ? "with" : "without", options.pade ? "with" : "without"));
  const SourceRef source = texts.emplace_back(std::make_shared<const SourceText>(saved.path, saved.text));
  Diagnostics said;  // in the run that saved it
  auto stage = stage_of_dataset(source, options, Statements::kept, texts, said);
  if (!stage) {
    diagnostics.append(std::move(said));
    return std::nullopt;
  }
  if (!saved.edits.empty()) {
    std::string text;
    for (const std::string& edit : saved.edits) text += edit + "\n";
    auto parsed = parse_commands(texts.emplace_back(std::make_shared<const SourceText>(name, text)));
    const bool readable = !parsed.diagnostics.has_errors();
    if (!readable) diagnostics.append(std::move(parsed.diagnostics));
    stage = readable ? edited_stage(*stage, parsed.value.commands, options, texts, diagnostics) : std::nullopt;
    if (!stage) return std::nullopt;
    stage->edits = {};
    for (const std::string& edit : saved.edits) stage->edits.add(edit);
  }
  for (const auto& [file, contents] : files_of(*stage->model)) {
    for (const auto& known : saved.further) {
      if (known.path == file && known.fingerprint != contents)
        diagnostics.warning(
            "reloaded-in-part", {},
            fmt::format("{} has changed since {} was saved, and counts as it is now", known.path, name));
    }
  }
  stage->anew = true;
  stage->restated = {};
  return stage;
}

}  // namespace dynalin

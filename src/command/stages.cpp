#include "command/stages.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/read_file.h"
#include "elements/catalogue.h"

namespace dynalin {

namespace {

void keep_texts(const Job::Stage& stage, std::vector<SourceRef>& texts) {
  texts.insert(texts.end(), stage.model->further_sources.begin(), stage.model->further_sources.end());
}

// The equations, which show what is wrong with a model that can be read.
bool add_system(Job::Stage& stage, const SessionOptions& options, Diagnostics& diagnostics,
                const System* before = nullptr) {
  auto system = System::make(stage.model, {options.pade ? DelayReading::pade : DelayReading::first_order,
                                           before ? angle_names(before->layout()) : std::vector<AngleName>()});
  if (!system) {
    diagnostics.append(std::move(system.error()));
    return false;
  }
  stage.system = std::move(*system);
  return true;
}

// The model after some edits, and all that is wrong with them and with it.
struct EditedModel {
  Job::Stage stage;
  Diagnostics problems;
};

Diagnostic& add_to(Diagnostics& list, const Diagnostic& d, const Span& at) {
  Diagnostic& added = d.severity == Severity::error ? list.error(d.code, at, d.message, d.hint)
                                                    : list.warning(d.code, at, d.message, d.hint);
  added.notes = d.notes;
  return added;
}

bool is_among(const Diagnostics& list, const Diagnostic& d) {
  return std::ranges::any_of(list.items(), [&](const Diagnostic& other) {
    return other.code == d.code && other.message == d.message && other.at.source == d.at.source &&
           other.at.offset == d.at.offset;
  });
}

EditedModel edited_model(const Job::Stage& from, std::span<const Command> edits, const SessionOptions& options) {
  EditedModel made;
  DatasetEditor editor(from.dataset, edits.front().written, catalogue(), made.problems);
  made.stage.edits = from.edits;
  for (const Command& c : edits) {
    c.action->edit(editor);
    made.stage.edits.emplace_back(c.whole.text());
  }
  EditedDataset now = std::move(editor).finish();
  auto built = build_model(now.dataset, catalogue(), {options.user_value}, routine_options(options));
  made.stage.warned = from.warned;
  for (const Diagnostic& d : built.diagnostics.items()) {
    if (is_among(from.warned, d)) continue;
    add_to(made.problems, d, d.at);
    if (d.severity != Severity::error) add_to(made.stage.warned, d, d.at);
  }
  made.stage.dataset = std::move(now.dataset), made.stage.model = std::move(built.value);
  made.stage.restated = std::move(now.restated);
  if (!made.problems.has_errors()) add_system(made.stage, options, made.problems, from.system.get());
  return made;
}

// The edit that has brought a problem about, as the model before all of them had none: the last of the fewest that have
// it too.
const Command& cause_of(const Diagnostic& d, const Job::Stage& from, std::span<const Command> edits,
                        const SessionOptions& options) {
  std::size_t without = 0, with = edits.size();
  while (with - without > 1) {
    const std::size_t half = without + (with - without) / 2;
    const EditedModel fewer = edited_model(from, edits.first(half), options);
    const bool has_it =
        std::ranges::any_of(fewer.problems.items(), [&](const Diagnostic& f) { return f.message == d.message; });
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

RoutineOptions routine_options(const SessionOptions& options) {
  return {options.user_libraries, options.difference_user_routines};
}

std::optional<Job::Stage> stage_of_dataset(SourceRef source, const SessionOptions& options, Statements statements,
                                           std::vector<SourceRef>& texts, Diagnostics& diagnostics) {
  auto parsed = parse_dataset(std::move(source));
  const bool read = !parsed.diagnostics.has_errors();
  diagnostics.append(std::move(parsed.diagnostics));
  const auto dataset = std::make_shared<Dataset>(std::move(parsed.value));
  const bool kept = statements == Statements::kept;
  auto built =
      build_model(dataset, catalogue(), {.user_value = options.user_value, .read_once = kept ? nullptr : dataset},
                  routine_options(options));
  const bool sound = read && !built.diagnostics.has_errors();
  Job::Stage stage;
  for (const Diagnostic& d : built.diagnostics.items()) add_to(stage.warned, d, d.at);
  // Statements that could not be read leave gaps that the model would only complain about again.
  if (read || built.diagnostics.has_errors()) diagnostics.append(std::move(built.diagnostics));
  stage.dataset = dataset, stage.model = std::move(built.value);
  keep_texts(stage, texts);
  if (!kept) dataset->release_arguments();
  if (!sound || !add_system(stage, options, diagnostics)) return std::nullopt;
  return stage;
}

std::optional<Job::Stage> edited_stage(const Job::Stage& from, std::span<const Command> edits,
                                       const SessionOptions& options, std::vector<SourceRef>& texts,
                                       Diagnostics& diagnostics) {
  EditedModel edited = edited_model(from, edits, options);
  keep_texts(edited.stage, texts);
  if (!edited.problems.has_errors()) {
    diagnostics.append(std::move(edited.problems));
    return std::move(edited.stage);
  }
  for (const Diagnostic& d : edited.problems.items()) {
    const bool at_edit = std::ranges::any_of(edits, [&](const Command& c) { return c.at.source == d.at.source; });
    if (d.severity != Severity::error || at_edit) {
      add_to(diagnostics, d, d.at);
      continue;
    }
    const Command& cause = cause_of(d, from, edits, options);
    Diagnostic& moved = add_to(diagnostics, d, place_in(cause));
    if (d.at.source) moved.notes.insert(moved.notes.begin(), {d.at, "what does not go with it stands here"});
  }
  return std::nullopt;
}

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

std::string fingerprint_of(const Job::Stage& stage) {
  std::vector<std::string> more = stage.edits;
  for (auto& file : files_of(*stage.model)) more.push_back(std::move(file.fingerprint));
  return fingerprint(stage.dataset->source->text(), more);
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
    stage->edits = saved.edits;
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

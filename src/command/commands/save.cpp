// SAVE/{SYSTEM | STATES}, FILE=, TITLE=: writes the point, or the model with its settings and the point, so that RELOAD
// goes on from there. The file is there at once, whatever becomes of the run.
#include "command/commands/save.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <filesystem>

#include "command/output_plan.h"
#include "command/run_state.h"
#include "command/stages.h"
#include "output/saved_study.h"

namespace dynalin::commands {

namespace {

namespace fs = std::filesystem;

struct SaveArguments {
  bool system = false, states = false;
  std::string file, title;

  using W = SaveArguments;
  static constexpr std::array<Argument<W>, 4> arguments = {{
      {.name = "SYSTEM", .slot = &W::system, .help = "the model as it is now, its settings, and the states"},
      {.name = "STATES", .slot = &W::states, .help = "time and all values of the point"},
      {.name = "FILE",
       .slot = &W::file,
       .required = true,
       .help = "name of the file, which is written at once, whole or not at all"},
      {.name = "TITLE", .slot = &W::title, .help = "any text, kept in the file"},
  }};
};

std::shared_ptr<const CommandAction> read_save(CommandReader& reader) {
  SaveArguments w;
  if (!read_arguments(w, reader)) return nullptr;
  if (w.system == w.states) {
    reader.error("missing-option", reader.statement().at, "SAVE takes exactly one of SYSTEM and STATES");
    return nullptr;
  }
  auto action = std::make_shared<Save>();
  action->system = w.system, action->file = std::move(w.file), action->title = std::move(w.title);
  return action;
}

SavedFile::Model saved_model(const RunState& run, const Job::Stage& stage) {
  SavedFile::Model model;
  const SourceText& source = *stage.dataset->source;
  std::error_code unknown;
  const fs::path absolute = fs::absolute(source.name(), unknown);
  model.path = unknown ? source.name() : absolute.lexically_normal().string();
  model.text = source.text();
  model.edits = stage.edits.list();
  model.pade = run.options.pade;
  for (SavedFile::Model::Further& file : files_of(*stage.model)) {
    const fs::path path = fs::absolute(file.path, unknown);
    if (!unknown) file.path = path.lexically_normal().string();
    model.further.push_back(std::move(file));
  }
  for (const Command& c : run.settings_done) model.settings.emplace_back(c.whole.text());
  for (const std::string_view name : run.environment.names()) model.environment.emplace_back(name);
  return model;
}

StudyFailure failure(std::string why) { return StudyFailure({"saving", std::move(why), {}, "unwritable-file"}); }

constexpr CommandKind save_kind = {.name = "SAVE",
                                   .use = CommandUse::run,
                                   .summary = "writes the point, or model and point, for RELOAD",
                                   .example = "SAVE/STATES, FILE=braking.save",
                                   .arguments = detail::argument_infos<SaveArguments>,
                                   .read = read_save};

}  // namespace

StudyResult<void> Save::run(RunState& run) const {
  const Job::Stage& stage = run.job.stages[run.stage];
  SavedFile saved = saved_study(run.point, fingerprint_of(stage));
  saved.title = title;
  if (system) saved.system = saved_model(run, stage);
  const auto text = saved_text(saved);
  if (!text) return tl::unexpected(failure(text.error()));
  const std::string path = command_path(run.folder, file);
  // Under its name at once, for RELOAD. What goes to standard output waits for its turn.
  const auto destination = find_destination(path);
  const bool waits = destination && destination->kind == Destination::Kind::standard_output;
  RunFiles own(run.files.inputs());
  RunFiles& files = waits ? run.files : own;
  auto written = files.add({{path, [&](std::ostream& out) { out << *text; }}});
  if (written && !waits) written = files.commit(run.message);
  if (!written) return tl::unexpected(failure(written.error()));
  if (!waits) run.saved_files.push_back(path);
  fmt::print(run.message, "  Saved {} at time {:.9E} to {}\n", system ? "the system" : "the states", run.time(), path);
  if (run.terminal)
    fmt::print(*run.terminal, "saved {} at time {:g} to {}\n", system ? "the system" : "the states", run.time(), path);
  run.json.add_plain(run.command, run.time());
  return {};
}

std::span<const CommandKind> save() { return {&save_kind, 1}; }

}  // namespace dynalin::commands

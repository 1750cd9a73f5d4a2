// RELOAD/{SYSTEM | STATES}, FILE=, OUTPUT_PREFIX=, TITLE=: goes on from what SAVE has written. The model of a system is
// made by the planner (planner.h), as every other one.
#include "command/commands/reload.h"

#include <fmt/ostream.h>

#include "command/run_state.h"
#include "command/stages.h"
#include "output/saved_study.h"

namespace dynalin::commands {

namespace {

struct ReloadArguments {
  bool system = false, states = false;
  std::string file, prefix, title;

  using W = ReloadArguments;
  static constexpr std::array<Argument<W>, 5> arguments = {{
      {.name = "SYSTEM", .slot = &W::system, .help = "model, settings and states of a file of SAVE/SYSTEM"},
      {.name = "STATES",
       .slot = &W::states,
       .help = "time and values, for the elements of the present model that were saved"},
      {.name = "FILE", .slot = &W::file, .required = true, .help = "a file that SAVE has written"},
      {.name = "OUTPUT_PREFIX", .slot = &W::prefix, .help = "begins further output files, whose names begin so"},
      {.name = "TITLE", .slot = &W::title, .help = "of the model from then on, in further output files"},
  }};
};

std::shared_ptr<const CommandAction> read_reload(CommandReader& reader) {
  ReloadArguments w;
  if (!read_arguments(w, reader)) return nullptr;
  if (w.system == w.states) {
    reader.error("missing-option", reader.statement().at, "RELOAD takes exactly one of SYSTEM and STATES");
    return nullptr;
  }
  if (!w.title.empty() && w.prefix.empty()) {
    reader.error("missing-argument", reader.at("TITLE"), "TITLE of RELOAD needs OUTPUT_PREFIX",
                 "the title stands at the head of output files");
    return nullptr;
  }
  auto action = std::make_shared<Reload>();
  action->system = w.system, action->file = std::move(w.file);
  action->prefix = std::move(w.prefix), action->title = std::move(w.title);
  return action;
}

constexpr CommandKind reload_kind = {.name = "RELOAD",
                                     .use = CommandUse::run,
                                     .summary = "goes on from what SAVE has written",
                                     .example = "RELOAD/STATES, FILE=braking.save",
                                     .arguments = detail::argument_infos<ReloadArguments>,
                                     .read = read_reload};

}  // namespace

StudyResult<void> Reload::run(RunState& run) const {
  if (system) {
    run.settings = run.system().model().settings;
    run.settings_done.clear();
    run.take_printing();
    for (const Command& c : settings) {
      c.action->restore(run);
      run.settings_done.push_back(c);
    }
    for (const std::string& name : saved->system->environment) run.environment.set(name);
  }
  const Job::Stage& stage = run.job.stages[run.stage];
  ReloadedPoint found = reloaded(*saved, run.point.system, fingerprint_of(stage), file);
  run.remarks.say(found.remarks);
  run.point = std::move(found.point);
  run.point.values.initial_conditions = run.settings.initial_conditions;
  run.shown = false;
  fmt::print(run.message, "  Reloaded {} at time {:.9E} from {}{}\n", system ? "the system" : "the states", run.time(),
             file, saved->title.empty() ? "" : ": " + saved->title);
  if (run.terminal)
    fmt::print(*run.terminal, "reloaded {} at time {:g} from {}\n", system ? "the system" : "the states", run.time(),
               file);
  run.json.add_plain(run.command, run.time());
  return {};
}

std::span<const CommandKind> reload() { return {&reload_kind, 1}; }

}  // namespace dynalin::commands

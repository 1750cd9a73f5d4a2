// RELOAD/{SYSTEM | STATES}, FILE=, OUTPUT_PREFIX=, TITLE=: goes on from what SAVE has written. The model of a system is
// made by the planner (planner.h), as every other one.
#include "command/commands/reload.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include "command/run_state.h"
#include "command/stages.h"

namespace dynalin::commands {

namespace {

struct Written {
  bool system = false, states = false;
  std::string file, prefix, title;

  using W = Written;
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

std::shared_ptr<const CommandAction> read(CommandReader& reader) {
  Written w;
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

// "PART/2, PART/3 and 4 more"
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  const std::vector<std::string> first(names.begin(),
                                       names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size())));
  const std::string text = fmt::format("{}", fmt::join(first, ", "));
  return names.size() <= most ? text : fmt::format("{} and {} more", text, names.size() - most);
}

constexpr CommandKind kind = {.name = "RELOAD",
                              .use = CommandUse::run,
                              .summary = "goes on from what SAVE has written",
                              .example = "RELOAD/STATES, FILE=braking.save",
                              .arguments = detail::argument_infos<Written>,
                              .read = read};

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
  const bool same_model = saved->fingerprint == fingerprint_of(stage);
  RestoredPoint restored = restored_point(saved->point, run.system());
  if (!restored.not_here.empty())
    run.remarks.say("reloaded-in-part",
                    fmt::format("{} has values of {}, which the model does not have; they are left out", file,
                                listed(restored.not_here)));
  if (!restored.not_saved.empty())
    run.remarks.say("reloaded-in-part", fmt::format("{} has no values of {}, which start as they are drawn", file,
                                                    listed(restored.not_saved)));
  if (!restored.others.empty())
    run.remarks.say("reloaded-in-part",
                    fmt::format("{} has other coordinates of {} than the model; they are not taken, and these start as "
                                "they are drawn",
                                file, listed(restored.others)));
  const bool whole = restored.not_here.empty() && restored.not_saved.empty() && restored.others.empty();
  StudyPoint& point = run.point;
  point.values = std::move(restored.point);
  point.values.initial_conditions = run.settings.initial_conditions;
  point.started = saved->started;
  // In another model the same values need not agree with the constraints, and forces are others.
  point.consistent = saved->consistent && whole && same_model;
  point.restated = saved->restated;
  point.redundant_rows = saved->redundant_rows;
  point.statics.reset();
  if (saved->statics && point.consistent)
    point.statics = StaticSolution{saved->statics->iterations, saved->statics->imbalance,
                                   restored_point(saved->statics->at_rest, run.system()).point};
  run.shown = false;
  fmt::print(run.message, "  Reloaded {} at time {:.9E} from {}{}\n", system ? "the system" : "the states", run.time(),
             file, saved->title.empty() ? "" : ": " + saved->title);
  if (run.terminal)
    fmt::print(*run.terminal, "reloaded {} at time {:g} from {}\n", system ? "the system" : "the states", run.time(),
               file);
  run.json.add_plain(run.command, run.time());
  return {};
}

std::span<const CommandKind> reload() { return {&kind, 1}; }

}  // namespace dynalin::commands

// ENVIRONMENT/NAME=, VALUE=: sets an environment variable for the rest of the run.
#include "command/commands/environment.h"

#include <fmt/format.h>

#include "command/run_state.h"

namespace dynalin::commands {

namespace {

struct EnvironmentArguments {
  std::string name, value;

  using W = EnvironmentArguments;
  static constexpr std::array<Argument<W>, 2> arguments = {{
      {.name = "NAME", .slot = &W::name, .required = true, .help = "an environment variable, for the rest of the run"},
      {.name = "VALUE", .slot = &W::value, .help = "it counts as set whatever the value is"},
  }};
};

std::shared_ptr<const CommandAction> read_environment(CommandReader& reader) {
  EnvironmentArguments w;
  if (!read_arguments(w, reader)) return nullptr;
  return std::make_shared<SetEnvironment>(std::move(w.name));
}

constexpr CommandKind environment_kind = {.name = "ENVIRONMENT",
                                          .use = CommandUse::run,
                                          .summary = "sets an environment variable that LINEAR or statics look at",
                                          .example = "ENVIRONMENT/NAME=MSC_LINEAR_PBCS_STATES, VALUE=1",
                                          .arguments = detail::argument_infos<EnvironmentArguments>,
                                          .read = read_environment};

}  // namespace

StudyResult<void> SetEnvironment::run(RunState& run) const {
  if (!run.environment.set(name))
    run.remarks.say("environment-variable",
                    fmt::format("the environment variable {} means nothing here and is passed over", name));
  run.json.add_plain(run.command, run.time());
  return {};
}

std::span<const CommandKind> environment() { return {&environment_kind, 1}; }

}  // namespace dynalin::commands

// TIME: prints the time of the point.
#include <fmt/format.h>

#include "command/run_state.h"

namespace dynalin::commands {

namespace {

class Time final : public CommandAction {
 public:
  StudyResult<void> run(RunState& run) const override {
    run.print(fmt::format("  The present time is {:.9E}\n", run.time()));
    return {};
  }
};

struct TimeArguments {
  bool list = false;
  static constexpr std::array<Argument<TimeArguments>, 1> arguments = {{
      {.name = "LIST", .slot = &TimeArguments::list, .help = "the same"},
  }};
};

constexpr CommandKind time_kind = {.name = "TIME",
                                   .use = CommandUse::information,
                                   .summary = "prints the time of the point",
                                   .example = "TIME",
                                   .arguments = detail::argument_infos<TimeArguments>,
                                   .read = [](CommandReader& reader) -> std::shared_ptr<const CommandAction> {
                                     TimeArguments w;
                                     return read_arguments(w, reader) ? std::make_shared<Time>() : nullptr;
                                   }};

}  // namespace

std::span<const CommandKind> time() { return {&time_kind, 1}; }

}  // namespace dynalin::commands

// STOP: ends the run, also where it stands in a command file within another one. What follows is not read.
#include "command/run_state.h"

namespace dynalin::commands {

namespace {

class Stop final : public CommandAction {
 public:
  StudyResult<void> run(RunState&) const override { return {}; }
  bool needs_model() const override { return false; }
  bool stops() const override { return true; }
};

std::shared_ptr<const CommandAction> read(CommandReader& reader) {
  Diagnostics& diagnostics = reader.diagnostics();
  for (const WrittenArgument& w : reader.statement().arguments)
    diagnostics.error("unknown-argument", w.name, "STOP takes no arguments");
  return std::make_shared<Stop>();
}

constexpr CommandKind kind = {.name = "STOP",
                              .use = CommandUse::run,
                              .summary = "ends the run; what stands behind it is not read",
                              .example = "STOP",
                              .read = read};

}  // namespace

std::span<const CommandKind> stop() { return {&kind, 1}; }

}  // namespace dynalin::commands

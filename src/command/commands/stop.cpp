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

std::shared_ptr<const CommandAction> read_stop(CommandReader& reader) {
  const Statement& written = reader.statement();
  if (written.id) reader.error("unexpected-text", written.at, "STOP has no id");
  for (const WrittenArgument& w : written.arguments)
    reader.error("unknown-argument", w.name, "STOP takes no arguments", "a comment begins with '!'");
  return std::make_shared<Stop>();
}

constexpr CommandKind stop_kind = {.name = "STOP",
                                   .use = CommandUse::run,
                                   .summary = "ends the run; what stands behind it is not read",
                                   .example = "STOP",
                                   .read = read_stop};

}  // namespace

std::span<const CommandKind> stop() { return {&stop_kind, 1}; }

}  // namespace dynalin::commands

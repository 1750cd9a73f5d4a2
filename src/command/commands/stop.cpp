// STOP: ends the file. What follows is read and checked, and does not run.
#include "command/commands.h"

namespace dynalin::commands {

namespace {

class Stop final : public CommandAction {
 public:
  StudyResult<void> run(RunState&) const override { return {}; }
};

std::shared_ptr<const CommandAction> read(CommandReader& reader) {
  reader.file().stopped = true;
  return std::make_shared<Stop>();
}

constexpr CommandKind kind = {.name = "STOP",
                              .use = CommandUse::run,
                              .summary = "ends the file; what stands behind it is not read",
                              .example = "STOP",
                              .read = read};

}  // namespace

std::span<const CommandKind> stop() { return {&kind, 1}; }

}  // namespace dynalin::commands

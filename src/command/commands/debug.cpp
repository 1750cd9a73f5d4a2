// DEBUG/EPRINT: iterations of statics in the message file.
#include "command/commands/setting.h"
#include "elements/settings/analysis_settings.h"

namespace dynalin::commands {

namespace {

class Debug final : public SettingOf<WrittenDebug> {
 protected:
  void apply(RunState& run) const override {
    if (written.eprint || written.noeprint) run.preferences.iterations = written.eprint;
  }
};

constexpr auto debug_rows = std::to_array<SettingRow>({
    {"EPRINT", "EPRINT NOEPRINT", "NOEPRINT"},
    {"VERBOSE", "VERBOSE NOVERBOSE", "NOVERBOSE"},
    {"DUMP", "DUMP NODUMP", "NODUMP"},
    {"RHSDUMP", "RHSDUMP NORHSDUMP", "NORHSDUMP"},
    {"JMDUMP", "JMDUMP NOJMDUMP", "NOJMDUMP"},
    {"REQDUMP", "REQDUMP NOREQDUMP", "NOREQDUMP"},
    {"TOPOLOGY", "TOPOLOGY NOTOPOLOGY", "NOTOPOLOGY"},
    {"DOF", "DOF NODOF", "NODOF"},
    {"SCREEN", "SCREEN NOSCREEN", "NOSCREEN"},
});

}  // namespace

std::span<const CommandKind> debug() {
  static constexpr CommandKind kind =
      setting<Debug>("DEBUG", "how much of its work a solver prints", "DEBUG/EPRINT", {.rows = debug_rows});
  return {&kind, 1};
}

}  // namespace dynalin::commands

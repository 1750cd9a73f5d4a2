// OUTPUT/…: which files of requests and graphics are written from now on, and how.
#include "command/commands/setting.h"
#include "elements/settings/output_settings.h"

namespace dynalin::commands {

namespace {

class Output final : public SettingOf<WrittenOutput> {
 public:
  CommandFiles files() const override {
    OutputSettings asked;
    written.apply(asked);
    CommandFiles files;
    files.requests = asked.request_file, files.request_tables = asked.writes_tables();
    files.graphics = asked.graphics_file;
    return files;
  }

 protected:
  void apply(RunState& run) const override { written.apply(run.steps.settings); }
};

}  // namespace

std::span<const CommandKind> output() {
  static constexpr CommandKind kind =
      setting<Output>("OUTPUT", "which files of requests and graphics are written", "OUTPUT/REQSAVE, NOPRINT");
  return {&kind, 1};
}

}  // namespace dynalin::commands

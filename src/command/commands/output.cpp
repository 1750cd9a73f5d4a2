// OUTPUT/…: which files of requests and graphics are written from now on, and how.
#include "command/commands/setting.h"
#include "elements/settings/output_settings.h"

namespace dynalin::commands {

namespace {

constexpr auto output_rows = std::to_array<SettingRow>({
    {"request file", "REQSAVE NOREQSAVE", "NOREQSAVE"},
    {"graphics file", "GRSAVE NOGRSAVE", "NOGRSAVE"},
    {"tables", "PRINT NOPRINT", "PRINT where an OUTPUT asks for anything"},
    {"FIXED", "FIXED", "OFF"},
    {"angles", "YPR EULER", "EULER"},
    {"DSCALE", "DSCALE", "1"},
    {"DZERO", "DZERO", "none"},
    {"VSCALE", "VSCALE", "1"},
    {"VZERO", "VZERO", "none"},
    {"ASCALE", "ASCALE", "1"},
    {"AZERO", "AZERO", "none"},
    {"FSCALE", "FSCALE", "1"},
    {"FZERO", "FZERO", "none"},
});

constexpr SettingList output_list{.rows = output_rows};

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
  static constexpr CommandKind kind = setting<Output>("OUTPUT", "which files of requests and graphics are written",
                                                      "OUTPUT/REQSAVE, NOPRINT", output_list);
  return {&kind, 1};
}

}  // namespace dynalin::commands

// LSOLVER: checked, and nothing acts on it.
#include "command/commands/setting.h"
#include "elements/settings/analysis_settings.h"

namespace dynalin::commands {

namespace {

constexpr auto passed_over_rows = std::to_array<SettingRow>({
    {"TYPE", "AUTO CALAHAN HARWELL UMF", without_effect},
    {"STABILITY", "STABILITY", without_effect},
});

constexpr std::array passed_over_kinds = {
    setting<SettingOf<WrittenLinearSolver>>("LSOLVER", "of the solver of equations: checked, nothing acts on it",
                                            "LSOLVER/UMF", {.rows = passed_over_rows}),
};

}  // namespace

std::span<const CommandKind> settings_passed_over() { return passed_over_kinds; }

}  // namespace dynalin::commands

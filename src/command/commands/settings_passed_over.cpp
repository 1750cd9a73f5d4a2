// LSOLVER: checked, and nothing acts on it.
#include "command/commands/setting.h"
#include "elements/settings/analysis_settings.h"

namespace dynalin::commands {

namespace {

constexpr std::array kinds = {
    setting<SettingOf<WrittenLinearSolver>>("LSOLVER", "of the solver of equations: checked, nothing acts on it",
                                            "LSOLVER/UMF"),
};

}  // namespace

std::span<const CommandKind> settings_passed_over() { return kinds; }

}  // namespace dynalin::commands

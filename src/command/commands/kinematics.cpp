// KINEMATICS/…: how SIMULATE/KINEMATICS leads a model through time.
#include "command/commands/setting.h"
#include "elements/settings/analysis_settings.h"

namespace dynalin::commands {

namespace {

class Kinematics final : public SettingOf<WrittenKinematics> {
 protected:
  void apply(RunState& run) const override { written.apply(run.settings); }
};

constexpr auto kinematics_rows = std::to_array<SettingRow>({
    {"ALIMIT", "ALIMIT", "0.523599 (rad)", Shown::angle, true},
    {"ERROR", "ERROR", "   1.000000e-10", Shown::exponent},
    {"MAXIT", "MAXIT", "25"},
    {"PATTERN", "PATTERN", without_effect, Shown::pattern},
    {"TLIMIT", "TLIMIT", "none", Shown::number, true},
    {"AERROR", "AERROR", without_effect, Shown::number},
    {"AMAXIT", "AMAXIT", without_effect},
    {"APATTERN", "APATTERN", without_effect, Shown::pattern},
    {"HMAX", "HMAX", "none", Shown::number},
});

// Constraints agree as well as those of the initial conditions.
std::optional<std::string> kinematics_held(std::string_view label, bool stated, const Settings& settings) {
  if (stated || label != "ERROR") return std::nullopt;
  return shown_number(settings.initial_conditions.error.value_or(1e-10), Shown::exponent);
}

constexpr SettingList kinematics_list{.rows = kinematics_rows, .held = kinematics_held};

constexpr CommandKind kinematics_kind = setting<Kinematics>("KINEMATICS", "how SIMULATE/KINEMATICS goes through time",
                                                            "KINEMATICS/HMAX=0.01, MAXIT=10", kinematics_list);

}  // namespace

std::span<const CommandKind> kinematics() { return {&kinematics_kind, 1}; }

}  // namespace dynalin::commands

// IC/…: how far constraints may be from agreeing at the start, and how the iterations go that meet them.
#include "command/commands/setting.h"
#include "elements/settings/analysis_settings.h"

namespace dynalin::commands {

namespace {

class InitialConditions final : public SettingOf<WrittenInitialConditions> {
 protected:
  void apply(RunState& run) const override {
    written.apply(run.settings);
    run.point.values.initial_conditions = run.settings.initial_conditions;
    run.point.values.redundancy_tolerance =
        run.settings.initial_conditions.error.value_or(OperatingPoint().redundancy_tolerance);
  }
};

constexpr auto ic_rows = std::to_array<SettingRow>({
    {"ALIMIT", "ALIMIT", "0.500000 (rad)", Shown::angle, true},
    {"ERROR", "ERROR", "   1.000000e-10", Shown::exponent},
    {"MAXIT", "MAXIT", "50"},
    {"PATTERN", "PATTERN", without_effect, Shown::pattern},
    {"TLIMIT", "TLIMIT", "none", Shown::exponent, true},
    {"VERROR", "VERROR", "   1.000000e-08", Shown::exponent},
    {"AERROR", "AERROR", "   1.000000e-08", Shown::exponent},
    {"AMAXIT", "AMAXIT", "100"},
    {"APATTERN", "APATTERN", without_effect, Shown::pattern},
});

std::optional<std::string> ic_held(std::string_view label, bool stated, const Settings& settings) {
  if (stated || (label != "VERROR" && label != "AERROR")) return std::nullopt;
  return shown_number(std::max(100 * settings.initial_conditions.error.value_or(1e-10), 1e-8), Shown::exponent);
}

constexpr SettingList ic_list{.rows = ic_rows, .held = ic_held};

}  // namespace

std::span<const CommandKind> initial_conditions() {
  static constexpr CommandKind kind = setting<InitialConditions>(
      "IC", "how far constraints may be from agreeing at the start", "IC/ERROR=1E-6", ic_list);
  return {&kind, 1};
}

}  // namespace dynalin::commands

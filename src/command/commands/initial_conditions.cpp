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

}  // namespace

std::span<const CommandKind> initial_conditions() {
  static constexpr CommandKind kind =
      setting<InitialConditions>("IC", "how far constraints may be from agreeing at the start", "IC/ERROR=1E-6");
  return {&kind, 1};
}

}  // namespace dynalin::commands

// KINEMATICS/…: how SIMULATE/KINEMATICS leads a model through time.
#include "command/commands/setting.h"
#include "elements/settings/analysis_settings.h"

namespace dynalin::commands {

namespace {

class Kinematics final : public SettingOf<WrittenKinematics> {
 protected:
  void apply(RunState& run) const override { written.apply(run.settings); }
};

constexpr CommandKind kind =
    setting<Kinematics>("KINEMATICS", "how SIMULATE/KINEMATICS goes through time", "KINEMATICS/HMAX=0.01, MAXIT=10");

}  // namespace

std::span<const CommandKind> kinematics() { return {&kind, 1}; }

}  // namespace dynalin::commands

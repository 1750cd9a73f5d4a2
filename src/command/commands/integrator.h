#pragma once

#include "command/commands/setting.h"
#include "elements/settings/analysis_settings.h"

namespace dynalin::commands {

class Integrator final : public SettingOf<WrittenIntegrator> {
 protected:
  void apply(RunState& run) const override { written.apply(run.settings); }
};

}  // namespace dynalin::commands

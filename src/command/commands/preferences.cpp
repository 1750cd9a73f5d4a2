// PREFERENCES/SOLVER=: which solver the model was written for is worth a word.
#include "command/commands/setting.h"
#include "elements/settings/analysis_settings.h"

namespace dynalin::commands {

namespace {

class Preferences final : public SettingOf<WrittenPreferences> {
 protected:
  void apply(RunState& run) const override {
    Diagnostics remarks;
    written.note(remarks);
    run.remarks.say(remarks);
  }
};

}  // namespace

std::span<const CommandKind> preferences() {
  static constexpr CommandKind kind =
      setting<Preferences>("PREFERENCES", "which solver the model was written for", "PREFERENCES/SOLVER=CXX");
  return {&kind, 1};
}

}  // namespace dynalin::commands

// PREFERENCES/SOLVER=, SIMEXIT=, STATUS_MESSAGE=: which solver the model was written for is worth a word; whether a
// command that failed ends the session; whether a line shows how far a command is.
#include "command/commands/setting.h"
#include "elements/settings/analysis_settings.h"

namespace dynalin::commands {

namespace {

bool is_on(const OptionalWord& w) {
  return w.word.empty() || !find_keyword(w.word, std::array<std::string_view, 3>{"OFF", "NO", "FALSE"});
}

class Preferences final : public SettingOf<WrittenPreferences> {
 protected:
  void apply(RunState& run) const override {
    Diagnostics remarks;
    written.note(remarks);
    run.remarks.say(remarks);
    if (written.simexit.given) run.preferences.ends_after_failure = is_on(written.simexit);
    if (written.status_message.given) run.preferences.status_messages = is_on(written.status_message);
  }
};

constexpr auto preferences_rows = std::to_array<SettingRow>({
    {"SOLVER", "SOLVER", "CXX"},
    {"SIMEXIT", "SIMEXIT", "OFF"},
    {"STATUS_MESSAGE", "STATUS_MESSAGE", "ON"},
    {"LIBPATH", "LIBPATH", ""},
    {"CONTACT_GEOMETRY_LIBRARY", "CONTACT_GEOMETRY_LIBRARY", ""},
    {"CONTACT_FACETING_TOLERANCE", "CONTACT_FACETING_TOLERANCE", ""},
    {"NTHREADS", "NTHREADS THREAD", ""},
    {"FLEX_LIMIT_CHECK", "FLEX_LIMIT_CHECK", ""},
});

}  // namespace

std::span<const CommandKind> preferences() {
  static constexpr CommandKind kind =
      setting<Preferences>("PREFERENCES", "of the session: its end after a failure, its status line",
                           "PREFERENCES/SIMEXIT=ON", {.rows = preferences_rows});
  return {&kind, 1};
}

}  // namespace dynalin::commands

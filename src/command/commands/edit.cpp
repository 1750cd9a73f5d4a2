#include "command/commands/edit.h"

#include <fmt/ostream.h>

#include "command/run_state.h"

namespace dynalin::commands {

namespace {

// Neighbouring edits have made one model together: what it takes out is told once, at the first of them.
void tell_what_is_inactive(RunState& run) {
  if (std::exchange(run.inactive_of, run.stage) == run.stage) return;
  const std::set<std::string> before = std::exchange(run.inactive, {});
  for (const auto& set : run.system().model().sets) {
    if (set->active) continue;
    const bool exerts = can_exert(set->kind());
    for (const ElementLabel& label : set->labels) {
      const std::string name = label.full_text();
      run.inactive.insert(name);
      if (before.contains(name)) continue;
      fmt::print(run.message, "   Deactivated {}{}.\n", name,
                 exerts ? ", force/torque values will be zero in function-expression references" : "");
    }
  }
  for (const std::string& name : before) {
    if (!run.inactive.contains(name)) fmt::print(run.message, "   Activated {}.\n", name);
  }
}

}  // namespace

StudyResult<void> Edit::run(RunState& run) const {
  tell_what_is_inactive(run);
  run.remarks.pass_over(run.system().model().settings.passed_over);
  if (!tell(run)) run.json.add_plain(run.command, run.time());
  return {};
}

}  // namespace dynalin::commands

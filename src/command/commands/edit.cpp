#include "command/commands/edit.h"

#include <fmt/ostream.h>

#include "command/run_state.h"

namespace dynalin::commands {

StudyResult<void> Edit::run(RunState& run) const {
  const std::set<std::string> before = std::exchange(run.inactive, {});
  for (const auto& set : run.system().model().sets) {
    if (set->active) continue;
    for (const ElementLabel& label : set->labels) {
      const std::string name = label.full_text();
      run.inactive.insert(name);
      if (before.contains(name)) continue;
      fmt::print(run.message,
                 "   Deactivated {}, force/torque values will be zero in function-expression references.\n", name);
    }
  }
  run.json.add_plain(run.command, run.time());
  return {};
}

}  // namespace dynalin::commands

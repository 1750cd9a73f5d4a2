#pragma once

#include <optional>

#include "command/command_kind.h"
#include "study/simulation.h"

namespace dynalin::commands {

class Simulate final : public CommandAction {
 public:
  StudyResult<void> run(RunState&) const override;

  bool initial_conditions = false;         // else statics, or over time
  Level last_level = Level::acceleration;  // of initial conditions
  std::optional<SimulationKind> kind;      // over time
  std::optional<double> end, duration, output_step;
  std::optional<std::int64_t> steps;

 private:
  StudyResult<void> run_over_time(RunState&) const;
};

}  // namespace dynalin::commands

// Where the steps of a simulation over time go: into the message file, the files of steps and the history for programs.
//
//     StepOutput output(run, StepKind::dynamics, request.times, request.integrator);
//     auto found = simulate(run.point, request, [&](const SimulationStep& step) { return output.add(step); });
//     if (auto written = output.end(); !written) return written;
#pragma once

#include "command/run_state.h"
#include "output/simulation_message.h"
#include "simulation/output_times.h"
#include "study/simulation.h"

namespace dynalin {

class StepOutput {
 public:
  StepOutput(RunState&, StepKind, const OutputTimes&, const IntegratorSettings& = {});

  // Takes every step. A simulation whose files cannot be written goes on no further.
  GoOn add(const SimulationStep&);
  // However the simulation ended, all steps so far are in the files and its history in the results for programs. The
  // failure of a file is the error.
  StudyResult<void> end();

 private:
  RunState& run_;
  SimulationMessage message_;
  History history_;  // of every output time: the one thing that grows with them, and only where --json wants it
  double time_;      // of the last step
};

}  // namespace dynalin

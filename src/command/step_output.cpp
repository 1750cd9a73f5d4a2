#include "command/step_output.h"

#include "study/history.h"
#include "system/operating_state.h"

namespace dynalin {

StepOutput::StepOutput(RunState& run, StepKind kind, const OutputTimes& times, const IntegratorSettings& integrator)
    : run_(run),
      message_(run.message,
               {kind, times.start(), times.end(), integrator.error, integrator.type, integrator.formulation}),
      time_(times.start()) {
  run_.steps.begin(kind);
}

GoOn StepOutput::add(const SimulationStep& step) {
  time_ = step.point.time;
  message_.add(step.point.time, step.statistics);
  if (!step.text.empty()) run_.message << step.text;
  if (!step.output) return GoOn::yes;
  const PointRequests requests = requests_at(step.system, step.point);
  if (run_.steps.wanted()) run_.steps.add(step.system.model(), state_over_time(step.system, step.point), requests);
  run_.say_undefined_requests(step.system, step.point, requests);
  if (!run_.options.json.empty()) append(history_, step.system, step.point, requests.values);
  return run_.steps.error().empty() ? GoOn::yes : GoOn::no;
}

StudyResult<void> StepOutput::end() {
  message_.end();
  run_.steps.end();
  run_.json.add(run_.command, time_, history_);
  if (std::string error = run_.steps.error(); !error.empty())
    return tl::unexpected(StudyFailure({"output", std::move(error), {}}));
  return {};
}

}  // namespace dynalin

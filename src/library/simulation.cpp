#include "study/simulation.h"

#include "analysis/static_settings.h"
#include "dynalin/study.h"
#include "library/inside.h"
#include "library/request_checks.h"
#include "study/history.h"

namespace dynalin::library {

namespace {

OutputTimes times_of(const SimulationRequest& request, double start) {
  if (request.steps) return OutputTimes::of_count(start, request.end, *request.steps);
  return OutputTimes(start, request.end, request.output_step.value_or(request.end - start));
}

}  // namespace

Simulation Study::simulate(const OperatingPoint& from, const SimulationRequest& request) const {
  const StudyPoint& start = point_of(model_, from);
  check(request, from.time());
  const Settings& stated = model_.inside().system->model().settings;
  dynalin::SimulationRequest whole{request.kind, times_of(request, from.time())};
  whole.integrator = stated.integrator;
  IntegratorSettings asked;
  asked.error = request.error, asked.largest_step = request.largest_step, asked.first_step = request.first_step;
  asked.least_step = request.least_step, asked.largest_order = request.largest_order;
  take_over(whole.integrator, asked);
  whole.kinematics = stated.kinematics;
  whole.statics = statics_options(stated.equilibrium);
  History history;
  const auto watch = [&](const SimulationStep& now) {
    if (now.output) append(history, now.system, now.point);
    if (!request.watch) return GoOn::yes;
    // The watcher may keep what it was told for longer than the instant lasts.
    const auto over = std::make_shared<bool>(false);
    const struct AtEnd {
      bool& over;
      ~AtEnd() { over = true; }
    } at_end{*over};
    const auto point = [over, &now, &start] {
      if (*over)
        fail(Failure{"simulation", "the instant is over: its point is there during the call of watch alone", {}});
      StudyPoint at = start;
      at.values = now.point, at.started = true, at.consistent = now.output;
      at.statics.reset();
      return OperatingPoint(std::make_shared<const OperatingPoint::Inside>(OperatingPoint::Inside{std::move(at), {}}));
    };
    return request.watch({now.point.time, now.output, now.statistics, point}) ? GoOn::yes : GoOn::no;
  };
  SimulatedPoint found = value_or_throw(dynalin::simulate(start, whole, watch));
  return {OperatingPoint(std::make_shared<const OperatingPoint::Inside>(
              OperatingPoint::Inside{std::move(found.point), remarks_of(found.remarks)})),
          found.kind, found.end, found.statistics, std::move(history)};
}

}  // namespace dynalin::library

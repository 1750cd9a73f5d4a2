#include "study/simulation.h"

#include <fmt/format.h>

#include "routine/routine_findings.h"
#include "simulation/dynamics.h"
#include "simulation/kinematics.h"
#include "simulation/quasi_statics.h"
#include "simulation/reach.h"

namespace dynalin {

namespace {

tl::unexpected<StudyFailure> refused(std::string why, std::string_view code) {
  return tl::unexpected(StudyFailure(Failure{"simulation", std::move(why), {}, code}));
}

Result<AdvancedPoint> advance(const System& system, const SimulationRequest& request, std::size_t freedoms,
                              const SimulationWatch& watch, SimulatedPoint& result, Findings& findings) {
  const OperatingPoint& from = result.point.values;
  const Course course{request.times, watch, result.statistics, findings};
  if (result.kind == SimulationKind::quasi_statics) {
    auto end = advance_quasi_statics(system, from, request.statics, course);
    if (!end) return tl::unexpected(end.error());
    StaticsReport& s = end->statics;
    result.point.statics = StaticSolution{s.iterations, s.imbalance, std::move(s.at_rest)};
    return AdvancedPoint{std::move(end->point), end->end};
  }
  if (result.kind == SimulationKind::kinematics && (freedoms > 0 || !needs_integration(system)))
    return advance_kinematics(system, from, request.kinematics, course);
  return advance_dynamics(system, from, request.integrator, course);
}

}  // namespace

SimulationKind kind_at(const StudyPoint& point, SimulationKind asked) {
  if (asked != SimulationKind::transient) return asked;
  return degrees_of_freedom(*point.system, point.values) > 0 ? SimulationKind::dynamics : SimulationKind::kinematics;
}

StudyResult<SimulatedPoint> simulate(StudyPoint from, const SimulationRequest& request, const SimulationWatch& watch) {
  auto start = initial_conditions(std::move(from));
  if (!start) return tl::unexpected(start.error());
  SimulatedPoint result;
  result.point = std::move(start->point), result.remarks = std::move(start->remarks);
  const System& system = *result.point.system;
  if (!(request.times.end() > result.point.values.time)) {
    return refused(fmt::format("the end of a simulation, {:g}, is not after the present time, {:g}",
                               request.times.end(), result.point.values.time),
                   "end-of-simulation");
  }
  if (auto refusal = request.times.refusal()) return tl::unexpected(StudyFailure(std::move(*refusal)));
  const std::size_t freedoms = degrees_of_freedom(system, result.point.values);
  result.kind = kind_at(result.point, request.kind);
  Findings findings;
  if (result.kind == SimulationKind::dynamics && freedoms == 0 && system.coordinates() > 0) {
    findings.warnings.warning("no-freedom-in-dynamics", {},
                              "the model has no degree of freedom: its motion is integrated although it is prescribed; "
                              "SIMULATE/KINEMATICS finds it exactly");
  }
  result.point.statics.reset();
  RoutineFindings routines;
  const RoutineFindings::Scope watched(routines);
  std::optional<std::string> out_of_reach;
  const SimulationWatch watch_reach = [&](const SimulationStep& at) {
    out_of_reach = end_out_of_reach(request.times, at);
    return !out_of_reach && (!watch || watch(at) == GoOn::yes) ? GoOn::yes : GoOn::no;
  };
  auto advanced = advance(system, request, freedoms, watch_reach, result, findings);
  for (const std::string& wrong : routines.wrong_partials) findings.warnings.warning("wrong-derivative", {}, wrong);
  result.remarks.append(std::move(findings.warnings));
  if (out_of_reach) {
    return tl::unexpected(StudyFailure(Failure{"simulation", std::move(*out_of_reach), {}, "end-out-of-reach"},
                                       std::move(result.remarks)));
  }
  if (!advanced) return tl::unexpected(StudyFailure(advanced.error(), std::move(result.remarks)));
  result.point.values = std::move(advanced->point);
  result.point.redundant_rows.clear();
  for (const std::int32_t r : findings.redundant_rows) result.point.redundant_rows.push_back(system.row_text(r));
  result.end = advanced->end;
  return result;
}

}  // namespace dynalin

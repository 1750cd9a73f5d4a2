#include "analysis/initial.h"

#include "analysis/assembly_moves.h"
#include "analysis/stated_turns.h"

namespace dynalin {

Result<OperatingPoint> initial_conditions(const System& system, const OperatingPoint& from, const Restated& restated,
                                          Findings& findings, const LevelWatch& watch, Level last) {
  const auto watched = [&](Level level, OperatingPoint begun, const auto& solve) -> Result<OperatingPoint> {
    if (level > last) return begun;
    if (watch.level) watch.level(level, false);
    Result<OperatingPoint> op = solve(std::move(begun));
    if (op && watch.level) watch.level(level, true);
    return op;
  };
  const Progress told = watch.progress.of("initial conditions");
  const auto assemble = [&](OperatingPoint begun) {
    take_stated_turns(system, restated, begun);
    auto op = assemble_position(system, std::move(begun), findings, restated, told);
    if (op) warn_of_moves(system, from, *op, findings.warnings);
    return op;
  };
  const auto reconcile = [&](OperatingPoint op) {
    told.tell("velocities");
    return reconcile_velocity(system, std::move(op), findings, restated);
  };
  const auto accelerate = [&](OperatingPoint op) {
    told.tell("accelerations and reactions");
    return solve_acceleration(system, std::move(op), findings);
  };
  return watched(Level::position, from, assemble)
      .and_then([&](OperatingPoint op) { return watched(Level::velocity, std::move(op), reconcile); })
      .and_then([&](OperatingPoint op) { return watched(Level::acceleration, std::move(op), accelerate); });
}

Result<OperatingPoint> initial_conditions(const System& system, Findings& findings) {
  return initial_conditions(system, system.drawn(), Restated::all(), findings);
}

}  // namespace dynalin

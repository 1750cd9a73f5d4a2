#include "analysis/initial.h"

#include "analysis/assembly_moves.h"

namespace dynalin {

Result<OperatingPoint> initial_conditions(const System& system, const OperatingPoint& from, Starts starts,
                                          Velocities velocities, Findings& findings, const LevelWatch& watch) {
  const auto watched = [&](Level level, const auto& solve) {
    if (watch) watch(level, false);
    Result<OperatingPoint> op = solve();
    if (op && watch) watch(level, true);
    return op;
  };
  const auto assemble = [&] {
    auto op = assemble_position(system, from, findings, starts);
    if (op) warn_of_moves(system, from, *op, findings.warnings);
    return op;
  };
  return watched(Level::position, assemble)
      .and_then([&](OperatingPoint op) {
        return watched(Level::velocity, [&] {
          return (velocities == Velocities::kept ? reconcile_velocity : initial_velocity)(system, std::move(op),
                                                                                          findings);
        });
      })
      .and_then([&](OperatingPoint op) {
        return watched(Level::acceleration, [&] { return solve_acceleration(system, std::move(op), findings); });
      });
}

Result<OperatingPoint> initial_conditions(const System& system, Findings& findings) {
  return initial_conditions(system, system.drawn(), Starts::held, Velocities::stated, findings);
}

}  // namespace dynalin

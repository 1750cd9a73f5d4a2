#include "analysis/initial.h"

#include "analysis/assembly_moves.h"

namespace dynalin {

Result<OperatingPoint> initial_conditions(const System& system, const OperatingPoint& from, const Restated& restated,
                                          Findings& findings, const LevelWatch& watch) {
  const auto watched = [&](Level level, const auto& solve) {
    if (watch) watch(level, false);
    Result<OperatingPoint> op = solve();
    if (op && watch) watch(level, true);
    return op;
  };
  const auto assemble = [&] {
    auto op = assemble_position(system, from, findings, restated);
    if (op) warn_of_moves(system, from, *op, findings.warnings);
    return op;
  };
  return watched(Level::position, assemble)
      .and_then([&](OperatingPoint op) {
        return watched(Level::velocity, [&] { return reconcile_velocity(system, std::move(op), findings, restated); });
      })
      .and_then([&](OperatingPoint op) {
        return watched(Level::acceleration, [&] { return solve_acceleration(system, std::move(op), findings); });
      });
}

Result<OperatingPoint> initial_conditions(const System& system, Findings& findings) {
  return initial_conditions(system, system.drawn(), Restated::all(), findings);
}

}  // namespace dynalin

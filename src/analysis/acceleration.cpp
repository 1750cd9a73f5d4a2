#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/initial.h"
#include "analysis/saddle.h"

namespace dynalin {

namespace {
constexpr int iteration_limit = 50;
}

Result<OperatingPoint> solve_acceleration(const System& system, OperatingPoint op, Findings& findings) {
  const Layout& layout = system.layout();
  const Saddle saddle(system);
  ConstraintRows rows;
  rows.resize(layout);
  Equations eq;
  eq.resize(layout);
  Partition part;
  std::vector<std::string> history;
  double before = std::numeric_limits<double>::infinity();

  for (int iteration = 0; iteration < iteration_limit; ++iteration) {
    const Motion motion = system.motion(op);
    system.constraints(motion, rows);
    if (iteration == 0) {
      part = system.partition(rows, true);
      findings.redundant_rows = part.redundant;
      for (const std::int32_t r : part.redundant) op.lambda[static_cast<std::size_t>(r)] = 0.0;
    }
    system.equations(motion, rows, eq, {Column::acceleration, Column::lambda, Column::algebraic, Column::state_rate});

    Eigen::MatrixXd step = Eigen::MatrixXd::Zero(saddle.size(), 1);
    for (std::int32_t r = 0; r < eq.size(); ++r) step(saddle.equation(r), 0) = -eq.residual()[static_cast<std::size_t>(r)];
    for (std::int32_t k = 0; k < rows.size(); ++k) {
      if (!part.active[static_cast<std::size_t>(k)]) continue;
      const Taylor& phi = rows.along_motion(k);
      step(saddle.lambda(k), 0) = -(rows.level(k) == RowLevel::position ? phi.acceleration : phi.rate);
    }
    if (!step.allFinite()) {
      const std::string reason = system.fault(motion);
      return tl::unexpected(Failure{"acceleration initial conditions", reason.empty() ? "a force or constraint has no finite value" : reason, history});
    }
    ColumnMatrix matrix = saddle.matrix(eq, rows, part.active, {});
    SparseLu lu;
    if (!lu.factor(matrix)) {
      Failure f{"acceleration initial conditions", "the accelerations are not determined", undetermined(system, saddle, std::move(matrix))};
      if (!f.details.empty()) f.message = fmt::format("the accelerations are not determined: nothing fixes {}", fmt::join(f.details, ", "));
      return tl::unexpected(f);
    }
    lu.solve(step);
    double change = 0;
    const auto update = [&](std::vector<double>& x, std::int32_t offset) {
      double size = 0, moved = 0;
      for (std::size_t k = 0; k < x.size(); ++k) {
        const double d = step(offset + static_cast<Eigen::Index>(k), 0);
        x[k] += d;
        size = std::max(size, std::abs(x[k]));
        moved = std::max(moved, std::abs(d));
      }
      if (size > 0) change = std::max(change, moved / size);
    };
    update(op.acceleration, 0);
    update(op.lambda, saddle.lambda(0));
    update(op.algebraic, saddle.algebraic(0));
    update(op.state_rate, saddle.state(0));
    history.push_back(fmt::format("iteration {}: relative change {:.3e}", iteration, change));
    // Corrections at rounding level, or no longer falling: the point is as exact as it gets.
    if (change < 1e-14 || (change < 1e-9 && change > 0.25 * before)) return op;
    before = change;
  }
  return tl::unexpected(Failure{"acceleration initial conditions", "the equations for accelerations, reactions and algebraic values did not converge", history});
}

Result<OperatingPoint> initial_conditions(const System& system, Findings& findings) {
  return assemble_position(system, system.drawn(), findings)
      .and_then([&](OperatingPoint op) { return initial_velocity(system, std::move(op), findings); })
      .and_then([&](OperatingPoint op) { return solve_acceleration(system, std::move(op), findings); });
}

}  // namespace dynalin

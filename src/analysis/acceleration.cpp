#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/acceleration_rounding.h"
#include "analysis/initial.h"
#include "analysis/saddle.h"

namespace dynalin {

namespace {

constexpr int iteration_limit = 50;
// A step no longer than this, in units of what roundings of the point make of it, corrects nothing.
constexpr double rounding_units_of_step = 8;

// Largest residual of each group of equations relative to the largest sum of terms in that group: forces as they were
// added, and what the unknowns contribute.
double relative_imbalance(const ColumnMatrix& m, const Eigen::MatrixXd& residual, const Equations& eq,
                          const OperatingPoint& op, const Saddle& saddle) {
  Eigen::VectorXd terms = residual.col(0).cwiseAbs();
  for (std::int32_t r = 0; r < eq.size(); ++r) terms(saddle.equation(r)) += eq.magnitude()[static_cast<std::size_t>(r)];
  const auto n = static_cast<std::int32_t>(op.acceleration.size());
  for (std::int32_t c = 0; c < m.columns; ++c) {
    const auto at = [](const std::vector<double>& v, std::int32_t k) {
      return std::abs(v[static_cast<std::size_t>(k)]);
    };
    const double x = c < n                     ? at(op.acceleration, c)
                     : c < saddle.algebraic(0) ? at(op.lambda, c - n)
                     : c < saddle.state(0)     ? at(op.algebraic, c - saddle.algebraic(0))
                                               : at(op.state_rate, c - saddle.state(0));
    for_each_in_column(m, c, [&](std::int32_t r, double v) { terms(r) += std::abs(v) * x; });
  }
  double worst = 0;
  const auto group = [&](std::int32_t first, std::int32_t last) {
    if (first >= last) return;
    const double size = terms.segment(first, last - first).maxCoeff();
    if (size > 0) worst = std::max(worst, residual.col(0).segment(first, last - first).cwiseAbs().maxCoeff() / size);
  };
  group(0, n);
  group(saddle.algebraic(0), saddle.state(0));
  group(saddle.state(0), saddle.size());
  // Constraint rows are linear in the accelerations: one solution meets them, and at rest they are pure rounding.
  return worst;
}

// Corrects values that are already exact to rounding. What all but vanishes was rounding alone and is zero.
void correct(std::vector<double>& values, std::int32_t offset, const Eigen::MatrixXd& step) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double change = step(offset + static_cast<Eigen::Index>(k), 0);
    values[k] += change;
    if (std::abs(values[k]) <= 1e-3 * std::abs(change)) values[k] = 0;
  }
}

// What is zero but for the rounding of the point is zero.
void drop_rounding(std::vector<double>& values, std::int32_t offset, const Eigen::VectorXd& rounding) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::abs(values[k]) <= rounding(offset + static_cast<Eigen::Index>(k))) values[k] = 0;
  }
}

// The algebraic or differential equation that is farthest from being met, relative to its own terms; empty if all are.
std::string farthest_equation(const Layout& layout, const Equations& eq) {
  std::string name;
  double worst = 1e-6;
  const auto look = [&](std::int32_t row, const ElementLabel& owner) {
    const auto at = static_cast<std::size_t>(row);
    const double relative = std::abs(eq.residual()[at]) / std::max(eq.magnitude()[at], 1e-300);
    if (relative > worst) worst = relative, name = owner.full_text();
  };
  for (std::size_t k = 0; k < layout.algebraic.size(); ++k)
    look(eq.algebraic_row(static_cast<std::int32_t>(k)), *layout.algebraic[k].owner);
  for (std::size_t k = 0; k < layout.states.size(); ++k)
    look(eq.state_row(static_cast<std::int32_t>(k)), *layout.states[k].owner);
  return name;
}

// A value that began as the dataset states it and ends elsewhere; a static solution begins where it has moved it.
void warn_of_changed_starts(const Layout& layout, const std::vector<double>& before, const std::vector<double>& after,
                            Findings& findings) {
  for (std::size_t k = 0; k < layout.algebraic.size(); ++k) {
    const AlgebraicUnknown& a = layout.algebraic[k];
    const double change = std::abs(after[k] - a.guess), size = std::max(std::abs(a.guess), std::abs(after[k]));
    if (!a.guess_is_start || before[k] != a.guess || change <= 1e-9 * size) continue;
    findings.warnings.push_back(
        fmt::format("the initial value {:g} of {} contradicts the condition it follows from: it "
                    "starts at {:.9g}",
                    a.guess, a.owner->full_text(), after[k]));
  }
}

tl::unexpected<Failure> failure(std::string message, std::vector<std::string> details = {}) {
  return tl::unexpected(Failure{"acceleration initial conditions", std::move(message), std::move(details)});
}

}  // namespace

Result<OperatingPoint> solve_acceleration(const System& system, OperatingPoint op, Findings& findings) {
  const Layout& layout = system.layout();
  const Saddle saddle(system);
  ConstraintRows rows;
  rows.resize(layout);
  Equations eq;
  eq.resize(layout);
  std::vector<std::string> history;
  const std::vector<double> first_values = op.algebraic;
  double before = std::numeric_limits<double>::infinity();
  int stalled = 0;
  SparseLu lu;

  system.constraints(system.motion(op), rows);
  const Partition part = system.partition(rows, true);
  findings.redundant_rows = part.redundant;
  for (const std::int32_t r : part.redundant) op.lambda[static_cast<std::size_t>(r)] = 0.0;

  // Minus the residuals at a point, in the order of the saddle matrix.
  const auto evaluate = [&](const OperatingPoint& at, std::initializer_list<Column> wanted) {
    const Motion motion = system.motion(at);
    system.constraints(motion, rows);
    system.equations(motion, rows, eq, wanted);
    Eigen::MatrixXd missing = Eigen::MatrixXd::Zero(saddle.size(), 1);
    for (std::int32_t r = 0; r < eq.size(); ++r)
      missing(saddle.equation(r), 0) = -eq.residual()[static_cast<std::size_t>(r)];
    for (std::int32_t k = 0; k < rows.size(); ++k) {
      if (!part.active[static_cast<std::size_t>(k)]) continue;
      const Taylor& phi = rows.along_motion(k);
      missing(saddle.lambda(k), 0) = -(rows.level(k) == RowLevel::position ? phi.acceleration : phi.rate);
    }
    return missing;
  };

  const auto rounding_at = [&](const OperatingPoint& point) {
    return rounding_of_accelerations(system, lu, point,
                                     [&](const OperatingPoint& at) -> Eigen::VectorXd { return evaluate(at, {}); });
  };
  for (int iteration = 0; iteration < iteration_limit; ++iteration) {
    Eigen::MatrixXd step = evaluate(op, {Column::acceleration, Column::lambda, Column::algebraic, Column::state_rate});
    if (!step.allFinite()) {
      const std::string reason = system.fault(system.motion(op));
      return failure(reason.empty() ? "a force or constraint has no finite value" : reason, history);
    }
    ColumnMatrix matrix = saddle.matrix(eq, rows, part.active, {});
    const double imbalance = relative_imbalance(matrix, step, eq, op, saddle);
    history.push_back(fmt::format("iteration {}: relative imbalance {:.3e}", iteration, imbalance));
    // Solved once and balanced to rounding, or close and no longer falling: the point is as exact as it gets. Stiff
    // elements turn the rounding of positions into forces, so that a small imbalance that stays is rounding too. Where
    // all forces vanish an imbalance is relative to rounding, and the step has to be measured against that.
    stalled = imbalance > 0.1 * before ? stalled + 1 : 0;
    bool settled =
        iteration > 0 && (imbalance < 1e-15 || (imbalance < 1e-10 && stalled > 0) || (imbalance < 1e-6 && stalled > 3));
    const bool balanced = settled && imbalance < 1e-15;
    if (!settled) {
      before = imbalance;
      if (!lu.factor(matrix)) {
        if (const std::string reason = system.departure(system.motion(op)); !reason.empty()) return failure(reason);
        const std::vector<std::string> free = undetermined(system, saddle, std::move(matrix));
        const std::string named = free.empty() ? "" : fmt::format(": nothing fixes {}", fmt::join(free, ", "));
        return failure("the accelerations are not determined" + named, free);
      }
      lu.solve(step);
      settled = iteration > 0 && stalled > 0 &&
                (step.col(0).array().abs() <= rounding_units_of_step * rounding_at(op).array()).all();
    }
    if (settled) {
      if (const std::string reason = system.departure(system.motion(op)); !reason.empty()) return failure(reason);
      warn_of_changed_starts(layout, first_values, op.algebraic, findings);
      // What is zero by the structure of the model, such as the load of a body in free fall, becomes exactly zero.
      for (int correction = 0; correction < 2 && balanced; ++correction) {
        if (correction > 0) step = evaluate(op, {});
        lu.solve(step);
        correct(op.acceleration, 0, step);
        correct(op.lambda, saddle.lambda(0), step);
      }
      const Eigen::VectorXd rounding = rounding_at(op);
      drop_rounding(op.acceleration, 0, rounding);
      drop_rounding(op.lambda, saddle.lambda(0), rounding);
      return op;
    }
    const auto update = [&](std::vector<double>& x, std::int32_t offset) {
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += step(offset + static_cast<Eigen::Index>(k), 0);
    };
    update(op.acceleration, 0);
    update(op.lambda, saddle.lambda(0));
    update(op.algebraic, saddle.algebraic(0));
    update(op.state_rate, saddle.state(0));
  }
  const std::string name = farthest_equation(layout, eq);
  return failure("the equations for accelerations, reactions and algebraic values did not converge" +
                     (name.empty() ? "" : "; farthest from being met is the equation of " + name),
                 history);
}

Result<OperatingPoint> initial_conditions(const System& system, Findings& findings) {
  return assemble_position(system, system.drawn(), findings, Starts::held)
      .and_then([&](OperatingPoint op) { return initial_velocity(system, std::move(op), findings); })
      .and_then([&](OperatingPoint op) { return solve_acceleration(system, std::move(op), findings); });
}

}  // namespace dynalin

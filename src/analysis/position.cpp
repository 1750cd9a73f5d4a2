#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/displace.h"
#include "analysis/initial.h"

namespace dynalin {

namespace {

constexpr double position_tolerance = 1e-13;  // relative to the scale of the row
constexpr int iteration_limit = 50;
constexpr double exact_weight = 1e8;  // of coordinates that EXACT asks to keep

double row_scale(const System& system, std::span<const ConstraintRows::Entry> row) {
  double scale = 0;
  for (const auto& e : row) scale = std::max(scale, std::abs(e.c.g) * system.coordinate_scale(e.column));
  return scale > 0 ? scale : 1.0;
}

std::vector<double> assembly_weights(const System& system) {
  std::vector<double> weight(system.coordinates());
  for (std::size_t k = 0; k < weight.size(); ++k) {
    const double s = system.coordinate_scale(static_cast<std::int32_t>(k));
    weight[k] = 1.0 / (s * s);
    // Coordinates outside bodies follow them.
    if (k >= static_cast<std::size_t>(system.layout().body_coordinate_count)) weight[k] *= follower_weight;
  }
  const Layout& layout = system.layout();
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    for (std::int32_t k = 0; k < block.count; ++k) {
      if (system.model().bodies[b].exact[static_cast<std::size_t>(k)]) {
        weight[static_cast<std::size_t>(block.offset + k)] *= exact_weight;
      }
    }
  }
  return weight;
}

}  // namespace

Violation position_violation(const System& system, const ConstraintRows& rows) {
  Violation v;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (rows.level(k) != RowLevel::position) continue;
    const double relative = std::abs(rows.along_motion(k).value) / row_scale(system, rows.row(k));
    if (relative > v.relative || std::isnan(relative)) v = {relative, k};
    if (std::isnan(relative)) break;
  }
  return v;
}

Result<OperatingPoint> assemble_position(const System& system, OperatingPoint op, Findings& findings, Starts starts) {
  const Layout& layout = system.layout();
  if (layout.problems.has_errors()) {
    Failure f{"initial conditions", layout.problems.items().front().message, {}};
    for (std::size_t k = 1; k < layout.problems.items().size(); ++k)
      f.details.push_back(layout.problems.items()[k].message);
    return tl::unexpected(std::move(f));
  }
  ConstraintRows rows;
  const std::size_t row_count = layout.row_count() + (starts == Starts::held ? system.starts().size() : 0);
  rows.resize(layout, row_count);
  const auto evaluate = [&] {
    const Motion motion = system.motion(op);
    system.constraints(motion, rows);
    if (starts == Starts::ignored) return;
    const auto first = static_cast<std::int32_t>(layout.row_count());
    system.start_rows(motion, first, rows);
    for (std::size_t k = 0; k < system.starts().size(); ++k) {
      if (!system.starts()[k].displacement) rows.drop(first + static_cast<std::int32_t>(k));
    }
  };
  const auto n = static_cast<Eigen::Index>(system.coordinates());
  const auto m = static_cast<Eigen::Index>(row_count);
  std::vector<double> weight;
  std::vector<std::string> history;
  double before = std::numeric_limits<double>::infinity();

  for (int iteration = 0; iteration < iteration_limit; ++iteration) {
    evaluate();
    const Violation v = position_violation(system, rows);
    history.push_back(fmt::format("iteration {}: largest violation {:.3e}", iteration, v.relative));
    if (std::isnan(v.relative)) {
      return tl::unexpected(
          Failure{"initial conditions", fmt::format("{} has no finite value", system.row_text(v.row)), history});
    }
    // Rounding sets the floor: stop there rather than wander.
    if (v.relative <= position_tolerance || (v.relative <= 1e-11 && v.relative >= 0.5 * before)) {
      system.remember(op);
      return op;
    }
    before = v.relative;

    const Partition part = system.partition(rows, false);
    for (const std::int32_t r : part.redundant) {
      // A dependent row that the others do not satisfy near the solution contradicts them.
      const double left = std::abs(rows.along_motion(r).value) / row_scale(system, rows.row(r));
      if (iteration > 5 && left > 0.9 * v.relative && left > 1e-9) {
        return tl::unexpected(
            Failure{"initial conditions",
                    fmt::format("the constraints contradict each other: {} cannot hold together with the others",
                                system.row_text(r)),
                    history});
      }
    }
    if (weight.empty()) weight = assembly_weights(system);
    std::vector<Triplet> entries;
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto i = static_cast<std::int32_t>(k);
      entries.push_back({i, i, weight[static_cast<std::size_t>(k)]});
    }
    Eigen::MatrixXd step = Eigen::MatrixXd::Zero(n + m, 1);
    for (std::int32_t k = 0; k < rows.size(); ++k) {
      const auto at = static_cast<std::int32_t>(n) + k;
      if (!part.active[static_cast<std::size_t>(k)]) {
        entries.push_back({at, at, 1.0});
        continue;
      }
      step(at, 0) = -rows.along_motion(k).value;
      for (const auto& e : rows.row(k)) {
        entries.push_back({at, e.column, e.c.g});
        entries.push_back({e.column, at, e.c.g});
      }
    }
    SparseLu lu;
    if (!lu.factor(compressed(static_cast<std::int32_t>(n + m), static_cast<std::int32_t>(n + m), entries))) {
      return tl::unexpected(Failure{"initial conditions", "the constraints are singular at this position", history});
    }
    lu.solve(step);
    displace(system, op, step.col(0).head(n), 0.5);
  }
  evaluate();
  const Violation v = position_violation(system, rows);
  findings.warnings.push_back(history.back());
  return tl::unexpected(Failure{"initial conditions",
                                fmt::format("the model could not be assembled: {} is violated by {:.3e} of its scale",
                                            system.row_text(v.row), v.relative),
                                history});
}

}  // namespace dynalin

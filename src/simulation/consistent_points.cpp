#include "simulation/consistent_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dynalin {

namespace {

constexpr std::size_t remark_limit = 50;

}  // namespace

Result<OperatingPoint> ConsistentPoints::at(OperatingPoint op, double left_out) {
  Findings found;
  const double t = op.time, tolerance = op.redundancy_tolerance;
  op.redundancy_tolerance = std::max(tolerance, left_out);
  auto result = assemble_position(system_, std::move(op), found)
                    .and_then([&](OperatingPoint p) { return reconcile_velocity(system_, std::move(p), found); })
                    .and_then([&](OperatingPoint p) { return accelerations(std::move(p), found); });
  if (!result) {
    Failure f = std::move(result.error());
    f.message = fmt::format("at time {:g}: {}", t, f.message);
    f.analysis = "dynamics";
    return tl::unexpected(std::move(f));
  }
  result->redundancy_tolerance = tolerance;
  findings_.redundant_rows = std::move(found.redundant_rows);
  for (const Diagnostic& d : found.warnings.items()) {
    if (said_.size() < remark_limit && is_new(d.message)) findings_.warnings.warning(d.code, d.at, d.message, d.hint);
  }
  return result;
}

Result<OperatingPoint> ConsistentPoints::accelerations(OperatingPoint op, Findings& found) const {
  auto near = solve_acceleration(system_, op, found);
  if (near) return near;
  const OperatingPoint drawn = system_.drawn();
  op.acceleration = drawn.acceleration, op.lambda = drawn.lambda;
  op.algebraic = drawn.algebraic, op.state_rate = drawn.state_rate;
  auto far = solve_acceleration(system_, std::move(op), found);
  return far ? std::move(far) : std::move(near);
}

}  // namespace dynalin

#include "simulation/moving_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/displace.h"
#include "analysis/initial.h"
#include "simulation/motion_courses.h"

namespace dynalin {

namespace {

constexpr double little = 1e-3;  // of the model's length, and of a radian

Partition partition_at(const System& system, const OperatingPoint& op) {
  ConstraintRows rows;
  rows.resize(system.layout());
  system.constraints(system.motion(op), rows);
  return system.partition(rows, RowLevel::velocity);
}

// The time in which something moves a little; 0 if nothing moves.
double time_ahead(const System& system, const OperatingPoint& op) {
  const auto largest = [&](const std::vector<double>& rates) {
    double most = 0;
    for (std::size_t k = 0; k < rates.size(); ++k)
      most = std::max(most, std::abs(rates[k]) / system.coordinate_scale(static_cast<std::int32_t>(k)));
    return most;
  };
  const double u = largest(op.velocity), a = largest(op.acceleration);
  // u h + a h²/2 = little
  const double root = u + std::sqrt(u * u + 2 * a * little);
  return root > 0 && std::isfinite(root) ? 2 * little / root : 0;
}

}  // namespace

std::vector<bool> rows_of_motion(const System& system, const OperatingPoint& op) {
  Partition here = partition_at(system, op);
  const double h = here.redundant.empty() ? 0 : time_ahead(system, op);
  if (h == 0) return std::move(here.active);
  OperatingPoint ahead = op;
  ahead.time += h;
  advance_courses(system, op, ahead);
  Eigen::VectorXd way(static_cast<Eigen::Index>(system.coordinates()));
  for (Eigen::Index k = 0; k < way.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    way(k) = h * (op.velocity[at] + 0.5 * h * op.acceleration[at]);
  }
  displace(system, ahead, way, {1.0});
  Findings unused;
  const auto met = assemble_position(system, std::move(ahead), unused);
  if (!met) return std::move(here.active);
  Partition there = partition_at(system, *met);
  return there.redundant.size() < here.redundant.size() ? std::move(there.active) : std::move(here.active);
}

void warn_of_change_point(const System& system, const OperatingPoint& start, Diagnostics& out) {
  const Partition here = partition_at(system, start);
  if (here.redundant.empty()) return;
  const std::vector<bool> moving = rows_of_motion(system, start);
  const auto dependent =
      std::ranges::find_if(here.redundant, [&](std::int32_t k) { return moving[static_cast<std::size_t>(k)]; });
  if (dependent == here.redundant.end()) return;
  out.warning("change-point", system.layout().rows[static_cast<std::size_t>(*dependent)].owner->at,
              fmt::format("the simulation begins at a change point, where {} depends on other constraints for this "
                          "instant alone: its beginning is less exact than ERROR says, and what hardly moves may not "
                          "leave it",
                          system.row_text(*dependent)),
              "begin a little beside it");
}

}  // namespace dynalin

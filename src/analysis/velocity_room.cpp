#include "analysis/velocity_room.h"

#include <algorithm>
#include <span>
#include <utility>

#include "analysis/velocity_norm.h"
#include "system/elimination.h"

namespace dynalin {

namespace {

// Of a gradient of size 1. What follows from others to the tolerance of the elimination may be more of it by the size
// of the rows that it has been taken from.
constexpr double no_room = 100 * EliminationOptions{}.rank_tolerance;
constexpr std::size_t solved_at_once = 64;

}  // namespace

// The velocities y that a force along the gradient g of a condition brings about, W y + Aᵀ ν = g with A y = 0, are what
// the constraints A leave of it: yᵀ W y, beside gᵀ W⁻¹ g without them.
std::vector<VelocityCondition> take_without_room(const System& system, const Motion& motion, const ConstraintRows& rows,
                                                 std::vector<VelocityCondition>& conditions) {
  const auto n = static_cast<std::int32_t>(system.coordinates());
  const std::vector<bool> active = system.partition(rows, RowLevel::velocity).active;
  const auto constraints = static_cast<std::ptrdiff_t>(active.size());
  std::vector<Triplet> weights;
  add_velocity_norm(system, motion, 1.0, weights);
  std::vector<Triplet> entries = weights;
  for (std::size_t k = 0; k < active.size(); ++k) {
    const std::int32_t at = n + static_cast<std::int32_t>(k);
    if (!active[k]) {
      entries.push_back({at, at, 1.0});
      continue;
    }
    for (std::size_t i = 0; i < conditions[k].column.size(); ++i) {
      entries.push_back({at, conditions[k].column[i], conditions[k].coefficient[i]});
      entries.push_back({conditions[k].column[i], at, conditions[k].coefficient[i]});
    }
  }
  SparseLu lu;
  const std::int32_t size = n + static_cast<std::int32_t>(active.size());
  if (!lu.factor(compressed(size, size, entries))) return {};
  std::vector<VelocityCondition> given_up, others(conditions.begin(), conditions.begin() + constraints);
  for (std::size_t first = active.size(); first < conditions.size(); first += solved_at_once) {
    const auto some = std::span(conditions).subspan(first, std::min(solved_at_once, conditions.size() - first));
    Eigen::MatrixXd y = Eigen::MatrixXd::Zero(size, static_cast<Eigen::Index>(some.size()));
    for (std::size_t k = 0; k < some.size(); ++k) {
      const double unit = unit_of(system, some[k]);
      for (std::size_t i = 0; i < some[k].column.size(); ++i)
        y(some[k].column[i], static_cast<Eigen::Index>(k)) += unit * some[k].coefficient[i];
    }
    lu.solve(y);
    for (std::size_t k = 0; k < some.size(); ++k) {
      const auto left = y.col(static_cast<Eigen::Index>(k));
      double square = 0;
      for (const Triplet& t : weights) square += left(t.row) * t.value * left(t.column);
      (square <= no_room * no_room ? given_up : others).push_back(some[k]);
    }
  }
  conditions = std::move(others);
  return given_up;
}

}  // namespace dynalin

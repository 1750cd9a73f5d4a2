#include "linear/configuration.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <random>

#include "analysis/acceleration_rounding.h"
#include "analysis/displace.h"
#include "analysis/row_sizes.h"
#include "linear/reach.h"
#include "system/elimination.h"

namespace dynalin {

namespace {

// Estimated roundings of entries below this are of no weight.
constexpr double suspicious = 1e-9;
constexpr int samples = 3;
constexpr double units = 1;          // in the last place
constexpr double sample_margin = 4;  // a sample is seldom the worst case

// Units of states in which they compare: a coordinate as far as it moves the model by its length or a radian, its rate
// the fastest rate of the linear model, or of the motion itself by its velocities and accelerations, times that.
Eigen::VectorXd units_of_states(const System& system, const OperatingPoint& op, const LinearSystem& linear) {
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(linear.A.rows());
  const auto n = static_cast<Eigen::Index>(linear.kinematic_states);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double most = linear.reach[static_cast<std::size_t>(k)].size;
    if (most > 0) unit(k) = 1 / most;
  }
  double fastest = 0;
  for (std::size_t c = 0; c < op.velocity.size(); ++c) {
    const double scale = system.coordinate_scale(static_cast<std::int32_t>(c));
    fastest = std::max({fastest, std::abs(op.velocity[c]) / scale, std::sqrt(std::abs(op.acceleration[c]) / scale)});
  }
  for (Eigen::Index r = 0; r < n; ++r) {
    if (!linear.model.states[static_cast<std::size_t>(r)].is_rate) continue;
    for (Eigen::Index c = 0; c < n; ++c) {
      const double entry = std::abs(linear.A(r, c)) * unit(c) / unit(r);
      fastest = std::max(fastest, linear.model.states[static_cast<std::size_t>(c)].is_rate ? entry : std::sqrt(entry));
    }
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    if (linear.model.states[static_cast<std::size_t>(k)].is_rate && fastest > 0) unit(k) *= fastest;
  }
  return unit;
}

}  // namespace

double relative_size(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                     const Eigen::MatrixXd& of) {
  const auto n = static_cast<Eigen::Index>(linear.kinematic_states);
  if (n == 0) return 0;
  const Eigen::VectorXd unit = units_of_states(system, op, linear).head(n);
  const auto largest = [&](const Eigen::MatrixXd& m) {
    return (unit.cwiseInverse().asDiagonal() * m.topLeftCorner(n, n).cwiseAbs() * unit.asDiagonal()).eval().maxCoeff();
  };
  const double size = largest(linear.A);
  return size > 0 ? largest(of) / size : 0;
}

LeastKnownRate least_known_rate(const System& system, const OperatingPoint& op, const LinearSystem& linear) {
  if (linear.A.size() == 0) return {};
  const Eigen::VectorXd unit = units_of_states(system, op, linear);
  const Eigen::MatrixXd unknown = linear.rounding + linear.uncertainty;
  LeastKnownRate found;
  for (Eigen::Index r = 0; r < linear.A.rows(); ++r) {
    const double size = (linear.model.A.row(r).cwiseAbs() * unit.asDiagonal()).maxCoeff();
    if (!(size > 0)) continue;
    const double part = (unknown.row(r).cwiseAbs() * unit.asDiagonal()).maxCoeff() / size;
    if (part > found.part) found = {part, static_cast<std::size_t>(r)};
  }
  return found;
}

Eigen::MatrixXd rounding_of_velocities(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                                       const Linearization& linearize_at) {
  if (relative_size(system, op, linear, linear.rounding) <= suspicious) return {};
  std::minstd_rand random(1);
  Eigen::MatrixXd worst = Eigen::MatrixXd::Zero(linear.A.rows(), linear.A.cols());
  for (int k = 0; k < samples; ++k) {
    Shake s = shake(system.layout(), op, coordinate_sizes(system.layout(), op), units, random);
    s.step.setZero();
    Findings ignored;
    auto there = reconcile_velocity(system, shaken(system, op, s, 1.0), ignored);
    if (there) there = solve_acceleration(system, std::move(*there), ignored);
    if (!there) return worst.setConstant(std::numeric_limits<double>::infinity());
    const auto other = linearize_at(*there);
    const auto same = [](const StateLabel& a, const StateLabel& b) { return a.text == b.text && a.owner == b.owner; };
    if (!other || !std::equal(linear.model.states.begin(), linear.model.states.end(), other->model.states.begin(),
                              other->model.states.end(), same))
      return worst.setConstant(std::numeric_limits<double>::infinity());
    worst = worst.cwiseMax((other->A - linear.A).cwiseAbs());
  }
  return sample_margin * worst;
}

namespace {

// A thousandth of the model away along the chosen coordinates, so that no symmetry survives.
std::optional<OperatingPoint> nearby(const System& system, const OperatingPoint& op, const LinearSystem& linear) {
  const Eigen::VectorXd step = uneven_motion(system, linear);
  constexpr double distance = 1e-3;
  OperatingPoint there = op;
  displace(system, there, distance * step, {1.0});
  Findings ignored;
  auto assembled = assemble_position(system, std::move(there), ignored);
  if (!assembled) return std::nullopt;
  return std::move(*assembled);
}

// Rows that depend on others to this part of their size.
RedundantRows redundant_rows(const System& system, const OperatingPoint& op, double tolerance) {
  ConstraintRows rows;
  rows.resize(system.layout());
  const Motion motion = system.motion(op);
  system.constraints(motion, rows);
  std::vector<SparseRow> scaled(static_cast<std::size_t>(rows.size()));
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (rows.level(k) == RowLevel::position) scaled[static_cast<std::size_t>(k)] = scaled_row(system, rows.row(k));
  }
  const std::vector<std::int32_t> order(system.preference().rbegin(), system.preference().rend());
  EliminationOptions options;
  options.rank_tolerance = tolerance;
  const Elimination e = eliminate(std::move(scaled), system.layout().coordinate_count, order, options);
  RedundantRows redundant{{}, e.largest_dropped};
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    if (rows.level(k) == RowLevel::position && e.pivot_column[static_cast<std::size_t>(k)] < 0)
      redundant.rows.push_back(k);
  }
  return redundant;
}

}  // namespace

NearDependence near_dependence(const System& system, const OperatingPoint& op, const StateChoice& choice) {
  // Poses are rounded: what depends on others to within that does so for all anybody can tell.
  constexpr double rounding_of_poses = 1e-13;
  NearDependence near;
  double tolerance = EliminationOptions{}.rank_tolerance;
  const RedundantRows dropped = choice.redundant ? *choice.redundant : redundant_rows(system, op, tolerance);
  near.left_out = dropped.rows;
  // With the smaller tolerance the same rows would go at the same time.
  if (dropped.left <= rounding_of_poses) return near;
  const std::vector<std::int32_t> always = redundant_rows(system, op, rounding_of_poses).rows;
  if (always.size() == dropped.rows.size()) return near;
  std::ranges::set_difference(dropped.rows, always, std::back_inserter(near.rows));
  while (redundant_rows(system, op, tolerance / 10).rows.size() == dropped.rows.size()) tolerance /= 10;
  near.distance = tolerance;
  return near;
}

std::vector<std::int32_t> rows_that_hold_nothing(const System& system, const OperatingPoint& op) {
  ConstraintRows rows;
  rows.resize(system.layout());
  system.constraints(system.motion(op), rows);
  std::vector<std::int32_t> found;
  for (std::int32_t k = 0; k < rows.size(); ++k) {
    const auto row = rows.row(k);
    if (!row.empty() && std::ranges::all_of(row, [](const auto& e) { return e.c.g == 0 && e.c.v == 0 && e.c.a0 == 0; }))
      found.push_back(k);
  }
  return found;
}

std::optional<FreedomsGained> freedoms_gained(const System& system, const OperatingPoint& op,
                                              const LinearSystem& linear) {
  const auto& here = linear.left_out;
  if (here.empty() || linear.kinematic_states == 0) return std::nullopt;
  const auto beside = nearby(system, op, linear);
  if (!beside) return std::nullopt;
  const auto there = redundant_rows(system, *beside, EliminationOptions{}.rank_tolerance).rows;
  if (there.size() >= here.size()) return std::nullopt;
  FreedomsGained gained;
  gained.count = here.size() - there.size();
  for (const std::int32_t r : here) {
    if (std::find(there.begin(), there.end(), r) == there.end()) gained.rows.push_back(r);
  }
  return gained;
}

}  // namespace dynalin

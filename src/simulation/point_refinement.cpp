#include "simulation/point_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/displace.h"
#include "analysis/initial.h"
#include "analysis/massless.h"
#include "analysis/outside_weight.h"
#include "analysis/row_sizes.h"
#include "analysis/row_violations.h"
#include "system/row_terms.h"

namespace dynalin {

namespace {

// Violations of rows by their scales, and residuals by their terms.
constexpr double left_out_tolerance = 1e-9, residual_tolerance = 1e-11;
constexpr double rounding_units = 4 * std::numeric_limits<double>::epsilon();
// Or by those that the integration leaves: what is zero but for rounding has no terms to be compared with.
constexpr double first_residual_tolerance = 1e-4;
// Of the fastest: steps of velocities.
constexpr double velocity_tolerance = 1e-13;
// Points are near: what does not converge in so few iterations is not what it is taken for.
constexpr int iteration_limit = 5;

}  // namespace

PointRefinement::PointRefinement(const System& system, std::vector<bool> active)
    : system_(system), active_(std::move(active)), lacks_mass_(lacks_mass(system)), augmented_(system) {
  rows_.resize(system.layout());
  eq_.resize(system.layout());
}

std::optional<OperatingPoint> PointRefinement::refined(OperatingPoint op) {
  if (lacks_mass_ || !refine_position(op) || !refine_velocity(op) || !refine_acceleration(op)) return {};
  if (!system_.domain_violation(system_.motion(op)).empty()) return {};
  return op;
}

// ⎡ W Gᵀ ⎤, W the squares of lengths: W δ + Gᵀν = 0, G δ = what rows miss
// ⎣ G 0  ⎦
bool PointRefinement::find_nearest(const OperatingPoint& op) {
  const Motion motion = system_.motion(op);
  system_.constraints(motion, rows_);
  const std::int32_t n = system_.layout().coordinate_count, m = rows_.size();
  std::vector<double> weight(static_cast<std::size_t>(n), 1.0);
  for (const ExtraBlock& e : system_.layout().extras)
    std::fill_n(weight.begin() + e.offset, e.count, outside_weight(e));
  std::vector<Triplet> entries;
  for (std::int32_t k = 0; k < n; ++k) {
    const double s = system_.coordinate_scale(k);
    entries.push_back({k, k, weight[static_cast<std::size_t>(k)] / (s * s)});
  }
  for (std::int32_t k = 0; k < m; ++k) {
    if (!active_[static_cast<std::size_t>(k)]) {
      entries.push_back({n + k, n + k, 1.0});
      continue;
    }
    for (const auto& e : rows_.row(k)) {
      entries.push_back({n + k, e.column, e.c.g});
      entries.push_back({e.column, n + k, e.c.g});
    }
  }
  return nearest_.factor(compressed(n + m, n + m, entries));
}

Eigen::VectorXd PointRefinement::least_change(Eigen::VectorXd of_rows) {
  const Eigen::Index n = system_.layout().coordinate_count;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n + of_rows.size());
  x.tail(of_rows.size()) = of_rows;
  nearest_.solve({x.data(), static_cast<std::size_t>(x.size())});
  return x.head(n);
}

bool PointRefinement::refine_position(OperatingPoint& op) {
  if (rows_.size() == 0) return true;
  if (!find_nearest(op)) return false;
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < iteration_limit; ++iteration) {
    if (iteration > 0) system_.constraints(system_.motion(op), rows_);
    const std::vector<double> sizes = coordinate_sizes(system_.layout(), op);
    const std::vector<RowTerms> terms = row_terms(system_, system_.motion(op));
    Eigen::VectorXd missing = Eigen::VectorXd::Zero(rows_.size());
    double left = 0, left_out = 0, beyond_rounding = 0;
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (rows_.level(k) != RowLevel::position) continue;
      const double scale = row_scale(system_, rows_.row(k)), value = rows_.along_motion(k).value;
      const double relative = std::abs(value) / scale;
      if (!std::isfinite(relative)) return false;
      if (!active_[static_cast<std::size_t>(k)]) {
        left_out = std::max(left_out, relative);
        continue;
      }
      missing(k) = -value;
      left = std::max(left, relative);
      const double rounding = row_rounding(sizes, rows_.row(k), terms[static_cast<std::size_t>(k)]) / scale;
      beyond_rounding = std::max(beyond_rounding, relative - std::max(position_tolerance, rounding));
    }
    if (beyond_rounding <= 0) {
      system_.remember(op);
      return left_out <= left_out_tolerance;
    }
    if (left > 0.5 * before) return false;
    before = left;
    constexpr double small_turn = 0.1;
    if (displace(system_, op, least_change(std::move(missing)), {small_turn}) < 1) return false;
  }
  return false;
}

bool PointRefinement::refine_velocity(OperatingPoint& op) {
  if (rows_.size() == 0) return true;
  for (int iteration = 0; iteration < iteration_limit; ++iteration) {
    system_.constraints(system_.motion(op), rows_);
    Eigen::VectorXd missing = Eigen::VectorXd::Zero(rows_.size());
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (!active_[static_cast<std::size_t>(k)]) continue;
      const Taylor& along = rows_.along_motion(k);
      missing(k) = -(rows_.level(k) == RowLevel::position ? along.rate : along.value);
    }
    const Eigen::VectorXd step = least_change(std::move(missing));
    if (!step.allFinite()) return false;
    double fastest = 0, longest = 0;
    for (std::size_t k = 0; k < op.velocity.size(); ++k) {
      const double s = system_.coordinate_scale(static_cast<std::int32_t>(k));
      const double change = step(static_cast<Eigen::Index>(k));
      op.velocity[k] += change;
      fastest = std::max(fastest, std::abs(op.velocity[k]) / s);
      longest = std::max(longest, std::abs(change) / s);
    }
    if (longest <= velocity_tolerance * fastest) return true;
  }
  return false;
}

// Of unknowns or equations that turn with the axes each three of a body have the largest of them: what is zero along
// one axis is rounding of the others.
void PointRefinement::spread_over_axes(Eigen::Ref<Eigen::VectorXd> of_coordinates) const {
  for (const BodyBlock& block : system_.layout().bodies) {
    for (std::int32_t k = 0; k < block.count; k += 3) {
      auto three = of_coordinates.segment<3>(block.offset + k);
      three.setConstant(three.maxCoeff());
    }
  }
}

void PointRefinement::evaluate(const OperatingPoint& op, std::initializer_list<PartialBy> wanted) {
  const Motion motion = system_.motion(op);
  system_.constraints(motion, rows_);
  system_.equations(motion, rows_, eq_, wanted);
  missing_ = terms_ = Eigen::VectorXd::Zero(augmented_.size());
  const Eigen::Index n = system_.layout().coordinate_count;
  for (std::int32_t r = 0; r < eq_.size(); ++r) {
    missing_(augmented_.equation(r)) = -eq_.residual()[static_cast<std::size_t>(r)];
    terms_(augmented_.equation(r)) = eq_.magnitude()[static_cast<std::size_t>(r)];
  }
  spread_over_axes(terms_.head(n));
  // Moments are rounded as forces are, by their levers.
  for (const BodyBlock& block : system_.layout().bodies) {
    for (std::int32_t k = block.offset + 3; block.turns() && k < block.offset + 6; ++k)
      terms_(k) = std::max(terms_(k), rounding_units / residual_tolerance * system_.length() * terms_(k - 3));
  }
  // g δq″ + 2 g′ δq′ + …: what does not depend on accelerations is nowhere told apart.
  const auto sizes = [&](const std::vector<double>& x) {
    Eigen::VectorXd size = Eigen::Map<const Eigen::VectorXd>(x.data(), n).cwiseAbs();
    spread_over_axes(size);
    return size;
  };
  const Eigen::VectorXd acceleration = sizes(op.acceleration), velocity = sizes(op.velocity);
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (!active_[static_cast<std::size_t>(k)]) continue;
    const Taylor& along = rows_.along_motion(k);
    const std::int32_t at = augmented_.lambda(k);
    missing_(at) = -(rows_.level(k) == RowLevel::position ? along.acceleration : along.rate);
    for (const auto& e : rows_.row(k))
      terms_(at) += std::abs(e.c.g) * acceleration(e.column) + std::abs(e.c.a1) * velocity(e.column);
  }
}

bool PointRefinement::refine_acceleration(OperatingPoint& op) {
  evaluate(op, {PartialBy::acceleration, PartialBy::lambda, PartialBy::algebraic, PartialBy::state_rate});
  if (!missing_.allFinite() || !eq_.clear_undefined().empty()) return false;
  if (!balance_.factor(augmented_.matrix(eq_, rows_, active_, {}))) return false;
  const Eigen::VectorXd first = missing_;
  for (int iteration = 0; iteration < iteration_limit; ++iteration) {
    balance_.solve({missing_.data(), static_cast<std::size_t>(missing_.size())});
    Eigen::Index at = 0;
    for (auto* part : {&op.acceleration, &op.lambda, &op.algebraic, &op.state_rate}) {
      for (double& v : *part) v += missing_(at++);
    }
    evaluate(op, {});
    bool met = true;
    for (Eigen::Index k = 0; k < missing_.size() && met; ++k) {
      const double left = std::abs(missing_(k));
      met = left <= residual_tolerance * terms_(k) || left <= first_residual_tolerance * std::abs(first(k));
    }
    if (met) return true;
  }
  return false;
}

}  // namespace dynalin

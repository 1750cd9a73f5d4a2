#include "simulation/kinematic_equations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/acceleration_rounding.h"
#include "analysis/row_sizes.h"
#include "analysis/row_violations.h"
#include "base/arbitrary_vector.h"
#include "system/row_terms.h"

namespace dynalin {

namespace {

constexpr double closure_rounding = std::numeric_limits<double>::epsilon();
// Newton's method has found a position if its step is shorter than position_tolerance, in lengths of the model and
// radians. Where rounding keeps steps from shrinking they may be as long as this.
constexpr double longest_rounding = 1e-9;
constexpr double least_contraction = 0.5;

}  // namespace

KinematicEquations::KinematicEquations(const System& system) : system_(system), augmented_(system) {
  rows_.resize(system.layout());
  equations_.resize(system.layout());
}

bool KinematicEquations::choose_rows(const OperatingPoint& op) {
  system_.constraints(system_.motion(op), rows_);
  ++evaluations_;
  partition_ = system_.partition(rows_, RowLevel::velocity);
  loose_.resize(0);
  return partition_.independent.empty();
}

// The rate of a row at rest is what its velocities have to make up for.
void KinematicEquations::evaluate(OperatingPoint& at_rest) {
  system_.constraints(system_.motion(at_rest), rows_);
  ++evaluations_;
}

bool KinematicEquations::factor() {
  const auto n = static_cast<std::int32_t>(system_.coordinates());
  std::vector<Triplet> entries;
  std::int32_t at = 0;
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (!partition_.active[static_cast<std::size_t>(k)]) continue;
    for (const auto& e : rows_.row(k)) entries.push_back({at, e.column, e.c.g});
    ++at;
  }
  ++factorizations_;
  return lu_.factor(compressed(n, n, entries));
}

double KinematicEquations::length_of(const Eigen::VectorXd& step) const {
  double length = 0;
  for (Eigen::Index k = 0; k < step.size(); ++k) {
    const double part = std::abs(step(k)) / system_.coordinate_scale(static_cast<std::int32_t>(k));
    if (!(part <= length)) length = part;  // what is no number is too long
  }
  return length;
}

bool KinematicEquations::contradicted(const OperatingPoint& op, double tolerance) const {
  if (partition_.redundant.empty()) return false;
  const std::vector<double> sizes = coordinate_sizes(system_.layout(), op);
  const std::vector<RowTerms> terms = row_terms(system_, system_.motion(op));
  return std::any_of(partition_.redundant.begin(), partition_.redundant.end(), [&](std::int32_t k) {
    const double scale = row_scale(system_, rows_.row(k)),
                 rounding = row_rounding(sizes, rows_.row(k), terms[static_cast<std::size_t>(k)]);
    return contradicts(std::abs(rows_.along_motion(k).value) / scale, rounding / scale, tolerance);
  });
}

std::optional<KinematicEquations::Missed> KinematicEquations::solve_position(OperatingPoint& op, const Limits& limits) {
  for (auto* x : {&op.velocity, &op.acceleration}) std::fill(x->begin(), x->end(), 0.0);
  const auto n = static_cast<Eigen::Index>(system_.coordinates());
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < limits.iterations; ++iteration) {
    ++iterations_;
    evaluate(op);
    if (!factor()) return Missed::singular;
    Eigen::MatrixXd step(n, 1);
    Eigen::Index at = 0;
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      if (partition_.active[static_cast<std::size_t>(k)]) step(at++, 0) = -rows_.along_motion(k).value;
    }
    lu_.solve(step);
    const double length = length_of(step.col(0));
    if (!std::isfinite(length)) return Missed::not_converged;
    const bool rounded = length >= least_contraction * before;
    if (length <= position_tolerance || (rounded && length <= longest_rounding)) {
      if (contradicted(op, limits.redundancy_tolerance)) return Missed::contradicted;
      return std::nullopt;
    }
    if (rounded) return Missed::not_converged;
    const double taken = displace(system_, op, step.col(0), limits.step);
    before = taken < 1 ? std::numeric_limits<double>::infinity() : length;
  }
  return Missed::not_converged;
}

void KinematicEquations::solve_velocity(OperatingPoint& op) const {
  Eigen::MatrixXd v(static_cast<Eigen::Index>(system_.coordinates()), 1);
  Eigen::Index at = 0;
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (partition_.active[static_cast<std::size_t>(k)]) v(at++, 0) = -rows_.along_motion(k).rate;
  }
  lu_.solve(v);
  op.velocity.assign(v.data(), v.data() + v.size());
}

// One step of the power method for GᵀG inverted.
double KinematicEquations::hold() {
  const auto n = static_cast<Eigen::Index>(system_.coordinates());
  Eigen::MatrixXd x(n, 1), y(n, 1);
  Eigen::VectorXd scale(n), row_size(n);
  for (std::int32_t k = 0; k < n; ++k) scale(k) = system_.coordinate_scale(k);
  Eigen::Index at = 0;
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (partition_.active[static_cast<std::size_t>(k)]) row_size(at++) = row_scale(system_, rows_.row(k));
  }
  if (loose_.size() != n) loose_ = arbitrary_vector(n, 1).real();
  x = row_size.cwiseProduct(loose_ / loose_.norm());
  lu_.solve(x);
  x = x.cwiseQuotient(scale).eval();
  const double length = x.norm();
  if (!(length > 0) || !std::isfinite(length)) return 0;
  y = x.cwiseQuotient(scale) / length;
  lu_.solve_transposed(y);
  y = y.cwiseProduct(row_size).eval();
  if (y.allFinite() && y.norm() > 0) loose_ = y;
  return 1 / length;
}

KinematicEquations::Loosest KinematicEquations::loosest() {
  for (int pass = 0; pass < 3; ++pass) hold();
  const auto n = static_cast<Eigen::Index>(system_.coordinates());
  Eigen::MatrixXd x(n, 1);
  std::vector<std::int32_t> row;
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (!partition_.active[static_cast<std::size_t>(k)]) continue;
    const auto at = static_cast<Eigen::Index>(row.size());
    x(at, 0) = row_scale(system_, rows_.row(k)) * loose_(at);
    row.push_back(k);
  }
  lu_.solve(x);
  for (std::int32_t k = 0; k < n; ++k) x(k, 0) /= system_.coordinate_scale(k);
  constexpr double share = 0.3;
  Loosest result;
  for (std::int32_t k = 0; k < n; ++k) {
    if (std::abs(x(k, 0)) >= share * x.cwiseAbs().maxCoeff())
      result.coordinates.push_back(system_.layout().coordinate_text(k));
    if (std::abs(loose_(k)) >= share * loose_.cwiseAbs().maxCoeff())
      result.rows.push_back(system_.row_text(row[static_cast<std::size_t>(k)]));
  }
  return result;
}

bool KinematicEquations::solve_acceleration(OperatingPoint& op) {
  constexpr int iteration_limit = 8;
  for (const std::int32_t k : partition_.redundant) op.lambda[static_cast<std::size_t>(k)] = 0;
  const std::array parts = {&op.acceleration, &op.lambda, &op.algebraic, &op.state_rate};
  Eigen::MatrixXd step = Eigen::MatrixXd::Zero(augmented_.size(), 1);
  ColumnMatrix factored;
  for (int iteration = 0; iteration < iteration_limit; ++iteration) {
    const Motion motion = system_.motion(op);
    system_.constraints(motion, rows_);
    system_.equations(motion, rows_, equations_,
                      {PartialBy::acceleration, PartialBy::lambda, PartialBy::algebraic, PartialBy::state_rate});
    ++evaluations_;
    if (!equations_.clear_undefined().empty()) return false;
    for (std::int32_t r = 0; r < equations_.size(); ++r)
      step(augmented_.equation(r), 0) = -equations_.residual()[static_cast<std::size_t>(r)];
    for (std::int32_t k = 0; k < rows_.size(); ++k) {
      const bool active = partition_.active[static_cast<std::size_t>(k)];
      step(augmented_.lambda(k), 0) = active ? -rows_.along_motion(k).acceleration : 0.0;
    }
    if (!step.allFinite()) return false;
    ColumnMatrix matrix = augmented_.matrix(equations_, rows_, partition_.active, {});
    const bool linear = iteration > 0 && matrix.value == factored.value;
    if (!linear) {
      ++factorizations_;
      if (!augmented_lu_.factor(matrix)) return false;
      factored = std::move(matrix);
    }
    augmented_lu_.solve(step);
    if (!step.allFinite()) return false;
    // Equations that are linear here are solved by the first step, and the second takes its rounding away.
    bool settled = linear;
    if (!linear && iteration > 0) {
      Eigen::VectorXd x(augmented_.size());
      Eigen::Index at = 0;
      for (const auto* part : parts) {
        for (const double v : *part) x(at++) = v;
      }
      Eigen::VectorXd terms = Eigen::VectorXd::Zero(augmented_.size());
      for (std::int32_t r = 0; r < equations_.size(); ++r)
        terms(augmented_.equation(r)) = equations_.magnitude()[static_cast<std::size_t>(r)];
      for_each_entry(factored, [&](std::int32_t r, std::int32_t c, double v) { terms(r) += std::abs(v * x(c)); });
      const Eigen::VectorXd allowed = rounding_of_solution(augmented_lu_, terms) + 4 * closure_rounding * x.cwiseAbs();
      settled = (step.col(0).cwiseAbs().array() <= allowed.array()).all();
    }
    Eigen::Index at = 0;
    for (auto* part : parts) {
      for (double& v : *part) {
        const double change = step(at++, 0);
        v += change;
        // What all but vanishes was rounding alone.
        if (settled && std::abs(v) <= 1e-3 * std::abs(change)) v = 0;
      }
    }
    if (settled) return true;
  }
  return false;
}

}  // namespace dynalin

#include "analysis/static_equations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/displace.h"
#include "analysis/initial.h"

namespace dynalin {

namespace {

bool finite(const std::vector<double>& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

StaticEquations::StaticEquations(const System& system)
    : system_(system), saddle_(system), coordinates_(system.layout().coordinate_count) {
  rows_.resize(system.layout());
  eq_.resize(system.layout());
  for (const DifferentialState& z : system.layout().states) held_.push_back(z.held_in_statics);
}

void StaticEquations::evaluate(const OperatingPoint& op, bool with_partials) {
  const Motion motion = system_.motion(op);
  system_.constraints(motion, rows_);
  if (with_partials || part_.active.empty()) part_ = system_.partition(rows_, false);
  if (with_partials) {
    system_.equations(motion, rows_, eq_, {Column::position, Column::lambda, Column::algebraic, Column::state});
  } else {
    system_.equations(motion, rows_, eq_, {});
  }
  residual_ = Eigen::VectorXd::Zero(saddle_.size());
  for (std::int32_t r = 0; r < eq_.size(); ++r)
    residual_(saddle_.equation(r)) = eq_.residual()[static_cast<std::size_t>(r)];
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (held_[k]) residual_(saddle_.state(static_cast<std::int32_t>(k))) = 0;
  }
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (part_.active[static_cast<std::size_t>(k)]) residual_(saddle_.lambda(k)) = rows_.along_motion(k).value;
  }
  measure_forces(op);
  if (with_partials && stiffness_ == 0) measure_stiffness();
}

double StaticEquations::imbalance() const {
  double worst = 0;
  for (std::int32_t k = 0; k < coordinates_; ++k) worst = std::max(worst, std::abs(residual_(k)) * force_unit(k));
  return worst;
}

double StaticEquations::unit(Eigen::Index k, double force) const {
  if (k < coordinates_) return force_unit(static_cast<std::int32_t>(k)) / force;
  return k < saddle_.algebraic(0) ? 1 / system_.length() : 1.0;
}

double StaticEquations::merit(const Eigen::VectorXd& residual, double force) const {
  if (!(force > 0)) force = 1.0;
  double sum = 0;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    const double r = residual(k) * unit(k, force);
    sum += r * r;
  }
  return sum;
}

std::string StaticEquations::worst(double force) const {
  if (!(force > 0)) force = 1.0;
  const Layout& layout = system_.layout();
  double largest = 0;
  std::int32_t at = -1;
  for (std::int32_t k = 0; k < saddle_.size(); ++k) {
    if (k >= saddle_.lambda(0) && k < saddle_.algebraic(0)) continue;  // constraints are met at every point of a search
    const double r = std::abs(residual_(k)) * unit(k, force);
    if (r > largest) largest = r, at = k;
  }
  if (at < 0) return {};
  if (at < coordinates_) return fmt::format("the unbalanced force is largest at {}", layout.coordinate_text(at));
  if (at < saddle_.state(0)) {
    const auto& w = layout.algebraic[static_cast<std::size_t>(at - saddle_.algebraic(0))];
    return fmt::format("{} has no value that agrees with its own function", w.owner->full_text());
  }
  const auto& z = layout.states[static_cast<std::size_t>(at - saddle_.state(0))];
  return fmt::format("the state of {} does not come to rest, its rate is still {:.3e}", z.owner->full_text(),
                     std::abs(residual_(at)));
}

double StaticEquations::rounding(const OperatingPoint& op) const {
  std::vector<double> size(system_.coordinates(), 1.0), force(system_.coordinates(), 0.0);
  const Layout& layout = system_.layout();
  for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
    for (std::int32_t k = 0; k < std::min(layout.bodies[b].count, 3); ++k) {
      size[static_cast<std::size_t>(layout.bodies[b].offset + k)] = norm(op.poses[b].r);
    }
  }
  for_each_entry(eq_.matrix(Column::position), [&](std::int32_t r, std::int32_t c, double k) {
    if (r < coordinates_) force[static_cast<std::size_t>(r)] += std::abs(k) * size[static_cast<std::size_t>(c)];
  });
  double worst = 0;
  for (std::int32_t k = 0; k < coordinates_; ++k)
    worst = std::max(worst, force[static_cast<std::size_t>(k)] * force_unit(k));
  return worst * std::numeric_limits<double>::epsilon();
}

void StaticEquations::settle(OperatingPoint& op) {
  Findings ignored;
  if (auto joined = assemble_position(system_, op, ignored)) op = std::move(*joined);
  OperatingPoint next = op;
  Eigen::VectorXd a = Eigen::VectorXd::Zero(coordinates_);
  const std::vector<bool> held(held_.size(), true);
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 12; ++iteration) {
    evaluate(next, true);
    std::vector<double> D(static_cast<std::size_t>(saddle_.size()), 0.0);
    for (std::int32_t k = 0; k < coordinates_; ++k) D[static_cast<std::size_t>(k)] = holding(k);
    SparseLu lu;
    const SaddleColumns columns{Column::position, Column::state, false};
    if (!residual_.allFinite() || !lu.factor(saddle_.matrix(eq_, rows_, part_.active, columns, {}, held, D))) return;
    Eigen::MatrixXd step = -residual_;
    for (Eigen::Index k = 0; k < a.size(); ++k) step(k, 0) -= D[static_cast<std::size_t>(k)] * a(k);
    for (std::int32_t k = 0; k < rows_.size(); ++k) step(saddle_.lambda(k), 0) = 0;
    for (std::size_t k = 0; k < held_.size(); ++k) step(saddle_.state(static_cast<std::int32_t>(k)), 0) = 0;
    const double size = step.cwiseAbs().maxCoeff();
    lu.solve(step);
    a += step.col(0).head(a.size());
    for (std::size_t k = 0; k < next.lambda.size(); ++k)
      next.lambda[k] += step(saddle_.lambda(static_cast<std::int32_t>(k)), 0);
    for (std::size_t k = 0; k < next.algebraic.size(); ++k)
      next.algebraic[k] += step(saddle_.algebraic(static_cast<std::int32_t>(k)), 0);
    if (size <= 1e-14 * force_scale_ || (iteration > 0 && size >= 0.5 * before && size <= 1e-9 * force_scale_)) break;
    before = size;
  }
  if (finite(next.lambda) && finite(next.algebraic)) op = std::move(next);
}

Eigen::VectorXd StaticEquations::row_units(double force) const {
  Eigen::VectorXd u(saddle_.size());
  for (Eigen::Index k = 0; k < u.size(); ++k) u(k) = unit(k, force > 0 ? force : 1.0);
  return u;
}

Eigen::VectorXd StaticEquations::column_units(const OperatingPoint& op) const {
  Eigen::VectorXd u = Eigen::VectorXd::Constant(saddle_.size(), std::max(force_scale_, 1e-300));
  for (std::int32_t k = 0; k < coordinates_; ++k) u(k) = system_.coordinate_scale(k);
  const auto sizes = [&](const std::vector<double>& x, std::int32_t offset) {
    for (std::size_t k = 0; k < x.size(); ++k) u(offset + static_cast<Eigen::Index>(k)) = std::max(1.0, std::abs(x[k]));
  };
  sizes(op.algebraic, saddle_.algebraic(0));
  sizes(op.state, saddle_.state(0));
  return u;
}

double StaticEquations::slope(const Eigen::VectorXd& step) const {
  return residual_.head(coordinates_).dot(step.head(coordinates_));
}

double StaticEquations::damping(const Eigen::VectorXd& step) const {
  double sum = 0;
  for (std::int32_t k = 0; k < coordinates_; ++k) sum += holding(k) * step(k) * step(k);
  return sum;
}

ColumnMatrix StaticEquations::tangent(double hold, double hold_states) const {
  std::vector<double> diagonal(static_cast<std::size_t>(saddle_.size()), 0.0);
  for (std::int32_t k = 0; k < coordinates_; ++k) diagonal[static_cast<std::size_t>(k)] = hold * holding(k);
  for (std::size_t k = 0; k < held_.size(); ++k) {
    diagonal[static_cast<std::size_t>(saddle_.state(static_cast<std::int32_t>(k)))] = held_[k] ? 0.0 : hold_states;
  }
  return saddle_.matrix(eq_, rows_, part_.active, {Column::position, Column::state}, {}, held_, diagonal);
}

// The largest entry of the first tangent as force per length; one yardstick for the whole search.
void StaticEquations::measure_stiffness() {
  for_each_entry(eq_.matrix(Column::position), [&](std::int32_t r, std::int32_t c, double k) {
    if (r < coordinates_) stiffness_ = std::max(stiffness_, std::abs(k) * force_unit(r) * force_unit(c));
  });
  if (stiffness_ == 0) stiffness_ = 1;
}

void StaticEquations::measure_forces(const OperatingPoint& op) {
  force_scale_ = 0;
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    for (const auto& e : rows_.row(k)) {
      force_scale_ =
          std::max(force_scale_, std::abs(e.c.g * op.lambda[static_cast<std::size_t>(k)]) * force_unit(e.column));
    }
  }
  for (const Body& b : system_.model().bodies)
    force_scale_ = std::max(force_scale_, b.mass * norm(system_.model().gravity));
  force_scale_ = std::max(force_scale_, imbalance());
}

OperatingPoint moved(const System& system, const OperatingPoint& from, const Saddle& saddle,
                     const Eigen::VectorXd& step, double fraction, double rotation_limit) {
  OperatingPoint to = from;
  const double f =
      fraction *
      displace(system, to, fraction * step.head(static_cast<Eigen::Index>(system.coordinates())), rotation_limit);
  const auto add = [&](std::vector<double>& x, std::int32_t offset) {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += f * step(offset + static_cast<Eigen::Index>(k));
  };
  add(to.lambda, saddle.lambda(0));
  add(to.algebraic, saddle.algebraic(0));
  add(to.state, saddle.state(0));
  return to;
}

}  // namespace dynalin

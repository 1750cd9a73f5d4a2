#include "analysis/static_equations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/comparable_scales.h"

namespace dynalin {

StaticEquations::StaticEquations(const System& system)
    : system_(system), augmented_(system), coordinates_(system.layout().coordinate_count) {
  rows_.resize(system.layout());
  eq_.resize(system.layout());
  eq_.keep_sizes();
  for (const DifferentialState& z : system.layout().states) held_.push_back(z.held_in_statics);
}

// Rows on velocities hold displacements as they hold velocities: what is at rest there pushes with λ Ψ_q′. Where one
// asks for the same as rows on positions do, these hold it.
Partition StaticEquations::partition_at_rest() const {
  const auto on_velocities = [&](std::int32_t k) { return rows_.level(k) == RowLevel::velocity; };
  Partition of_positions = system_.partition(rows_, RowLevel::position);
  std::vector<bool> left_out;
  for (std::int32_t k = 0; k < rows_.size(); ++k) left_out.push_back(on_velocities(k));
  if (std::ranges::find(left_out, true) == left_out.end()) return of_positions;
  const auto keeps_positions = [&](const Partition& p) {
    for (std::size_t k = 0; k < of_positions.active.size(); ++k)
      if (of_positions.active[k] && !p.active[k]) return false;
    return true;
  };
  Partition all = system_.partition(rows_, RowLevel::velocity);
  if (keeps_positions(all)) return all;
  Partition p = of_positions;
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (!on_velocities(k)) continue;
    const auto row = static_cast<std::size_t>(k);
    left_out[row] = false;
    Partition with = system_.partition(rows_, RowLevel::velocity, left_out);
    if (with.active[row] && keeps_positions(with) && with.independent.size() < p.independent.size()) {
      p = std::move(with);
    } else {
      left_out[row] = true;
    }
  }
  return p;
}

void StaticEquations::evaluate(const OperatingPoint& op, Partials wanted) {
  const Motion motion = system_.motion(op);
  system_.constraints(motion, rows_);
  if (wanted == Partials::yes || part_.active.empty()) part_ = partition_at_rest();
  if (wanted == Partials::yes) {
    using P = PartialBy;
    if (motion_)
      system_.equations(
          motion, rows_, eq_,
          {P::position, P::lambda, P::algebraic, P::state, P::velocity, P::damping, P::acceleration, P::state_rate});
    else
      system_.equations(motion, rows_, eq_, {P::position, P::lambda, P::algebraic, P::state});
    undefined_ = !eq_.clear_undefined().empty();
    eq_.clear_rounding(PartialBy::position);
  } else {
    system_.equations(motion, rows_, eq_, {});
  }
  residual_ = Eigen::VectorXd::Zero(augmented_.size());
  magnitude_ = Eigen::VectorXd::Zero(augmented_.size());
  for (std::int32_t r = 0; r < eq_.size(); ++r) {
    residual_(augmented_.equation(r)) = eq_.residual()[static_cast<std::size_t>(r)];
    magnitude_(augmented_.equation(r)) = eq_.magnitude()[static_cast<std::size_t>(r)];
  }
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (held_[k]) residual_(augmented_.state(static_cast<std::int32_t>(k))) = 0;
  }
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (part_.active[static_cast<std::size_t>(k)] && rows_.level(k) == RowLevel::position)
      residual_(augmented_.lambda(k)) = rows_.along_motion(k).value;
  }
  measure_forces(op);
  if (wanted == Partials::no) return;
  if (stiffness_ == 0) measure_stiffness();
  measure_rounding(op);
  measure_parts();
}

bool StaticEquations::factor(SparseLu& lu, ColumnMatrix m) {
  constexpr double overhead = 3000;  // products an unknown: evaluation and the analysis of the pattern
  const double size = std::max(1.0, static_cast<double>(m.rows));
  effort_ += overhead * size;
  if (!lu.factor(std::move(m))) return false;
  const auto entries = static_cast<double>(lu.entries());
  effort_ += entries * entries / size;
  return true;
}

double StaticEquations::imbalance() const {
  double worst = 0;
  for (std::int32_t k = 0; k < coordinates_; ++k) worst = std::max(worst, std::abs(residual_(k)) * force_unit(k));
  return worst;
}

double StaticEquations::imbalance_of_functions() const {
  const auto count = static_cast<std::int32_t>(system_.layout().algebraic.size());
  Eigen::MatrixXd change = -residual_.segment(augmented_.algebraic(0), count);
  if (change.isZero(0)) return imbalance();
  std::vector<Triplet> own;
  const ColumnMatrix& partials = eq_.matrix(PartialBy::algebraic);
  for_each_entry(partials, [&](std::int32_t r, std::int32_t c, double v) {
    if (r >= coordinates_ && r < coordinates_ + count) own.push_back({r - coordinates_, c, v});
  });
  SparseLu lu;
  if (!change.allFinite() || !lu.factor(compressed(count, count, own))) return imbalance();
  lu.solve(change);
  Eigen::VectorXd force = residual_.head(coordinates_);
  for_each_entry(partials, [&](std::int32_t r, std::int32_t c, double v) {
    if (r < coordinates_) force(r) += v * change(c, 0);
  });
  double worst = 0;
  for (std::int32_t k = 0; k < coordinates_; ++k) worst = std::max(worst, std::abs(force(k)) * force_unit(k));
  return worst;
}

double StaticEquations::rate_of_states() const {
  double fastest = 0;
  for (Eigen::Index k = augmented_.state(0); k < residual_.size(); ++k) {
    const double rate = std::abs(residual_(k));
    if (rate > 100 * rounding_(k)) fastest = std::max(fastest, rate);
  }
  return fastest;
}

double StaticEquations::unit(Eigen::Index k, double force) const {
  if (yardstick_ == Yardstick::part && (k < coordinates_ || k >= augmented_.algebraic(0))) {
    const double scale = own_scale_(k);
    return scale > 0 ? (k < coordinates_ ? force_unit(static_cast<std::int32_t>(k)) : 1.0) / scale : 0.0;
  }
  if (k < coordinates_) return force_unit(static_cast<std::int32_t>(k)) / force;
  return k < augmented_.algebraic(0) ? 1 / system_.length() : 1.0;
}

double StaticEquations::merit(double force) const {
  if (yardstick_ == Yardstick::model) return merit(residual_, force);
  double sum = 0;
  for (Eigen::Index k = 0; k < residual_.size(); ++k) {
    const double r = std::max(0.0, std::abs(residual_(k)) - 10 * rounding_(k)) * unit(k, force);
    sum += std::isnan(residual_(k)) ? residual_(k) : r * r;
  }
  return sum;
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

std::string StaticEquations::equation_text(Eigen::Index row) const {
  const Layout& layout = system_.layout();
  const auto k = static_cast<std::int32_t>(row);
  if (k < coordinates_) return layout.coordinate_text(k);
  if (k < augmented_.algebraic(0)) return system_.row_text(k - augmented_.lambda(0));
  if (k < augmented_.state(0))
    return "the value of " + layout.algebraic[static_cast<std::size_t>(k - augmented_.algebraic(0))].owner->full_text();
  return "the state of " + layout.states[static_cast<std::size_t>(k - augmented_.state(0))].owner->full_text();
}

std::string StaticEquations::worst(double force) const {
  if (!(force > 0)) force = 1.0;
  const Layout& layout = system_.layout();
  double largest = 0;
  std::int32_t at = -1;
  for (std::int32_t k = 0; k < augmented_.size(); ++k) {
    if (k >= augmented_.lambda(0) && k < augmented_.algebraic(0))
      continue;  // constraints are met at every point of a search
    const double r = std::abs(residual_(k)) * unit(k, force);
    if (r > largest) largest = r, at = k;
  }
  if (at < 0) return {};
  if (at < coordinates_) return fmt::format("the unbalanced force is largest at {}", layout.coordinate_text(at));
  if (at < augmented_.state(0)) {
    const auto& w = layout.algebraic[static_cast<std::size_t>(at - augmented_.algebraic(0))];
    return fmt::format("{} has no value that agrees with its own function", w.owner->full_text());
  }
  const auto& z = layout.states[static_cast<std::size_t>(at - augmented_.state(0))];
  return fmt::format(
      "the state of {} does not come to rest, its rate is still {:.3e} (with STATIC_HOLD it would keep its value)",
      z.owner->full_text(), std::abs(residual_(at)));
}

void StaticEquations::measure_parts() {
  if (own_scale_.size() == 0) {
    own_scale_ = Eigen::VectorXd::Zero(augmented_.size());
    own_stiffness_.assign(static_cast<std::size_t>(coordinates_), 0.0);
  }
  for (Eigen::Index k = 0; k < own_scale_.size(); ++k) {
    const double unit = k < coordinates_ ? force_unit(static_cast<std::int32_t>(k)) : 1.0;
    own_scale_(k) = std::max(own_scale_(k), magnitude_(k) * unit);
  }
  for (const BodyBlock& b : system_.layout().bodies) {
    if (b.count > 0)
      own_scale_.segment(b.offset, b.count).setConstant(own_scale_.segment(b.offset, b.count).maxCoeff());
  }
}

void StaticEquations::measure_by(Yardstick yardstick) {
  yardstick_ = yardstick;
  if (yardstick == Yardstick::model) return;
  own_scale_.setZero();  // what was far from here does not matter any more
  measure_parts();
  // The stiffness that holds a part in place; where nothing does, its forces over the length of the model.
  std::fill(own_stiffness_.begin(), own_stiffness_.end(), 0.0);
  for_each_entry(eq_.matrix(PartialBy::position), [&](std::int32_t r, std::int32_t c, double k) {
    if (r != c || r >= coordinates_) return;
    double& own = own_stiffness_[static_cast<std::size_t>(r)];
    own = std::max(own, std::abs(k) * force_unit(r) * force_unit(r));
  });
  for (std::int32_t k = 0; k < coordinates_; ++k) {
    double& own = own_stiffness_[static_cast<std::size_t>(k)];
    own = std::max(own, own_scale_(k) / system_.length());
  }
  for (const BodyBlock& b : system_.layout().bodies) {
    if (b.count == 0) continue;
    const auto first = own_stiffness_.begin() + b.offset;
    std::fill(first, first + b.count, *std::max_element(first, first + b.count));
  }
  for (double& own : own_stiffness_) {
    if (!(own > 0)) own = stiffness_;
  }
}

Eigen::VectorXd StaticEquations::row_units(double force) const {
  Eigen::VectorXd u(augmented_.size());
  for (Eigen::Index k = 0; k < u.size(); ++k) u(k) = unit(k, force > 0 ? force : 1.0);
  return u;
}

Eigen::VectorXd StaticEquations::column_units(const OperatingPoint& op) const {
  Eigen::VectorXd u = Eigen::VectorXd::Constant(augmented_.size(), std::max(force_scale_, 1e-300));
  for (std::int32_t k = 0; k < coordinates_; ++k) u(k) = system_.coordinate_scale(k);
  const auto sizes = [&](const std::vector<double>& x, std::int32_t offset) {
    for (std::size_t k = 0; k < x.size(); ++k) u(offset + static_cast<Eigen::Index>(k)) = std::max(1.0, std::abs(x[k]));
  };
  sizes(op.algebraic, augmented_.algebraic(0));
  sizes(op.state, augmented_.state(0));
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
  std::vector<double> diagonal(static_cast<std::size_t>(augmented_.size()), 0.0);
  const auto matrix = [&] {
    return augmented_.matrix(eq_, rows_, part_.active, {PartialBy::position, PartialBy::state}, {}, held_, diagonal);
  };
  if (hold_states > 0) {
    const ComparableScales scales(matrix());
    for (std::size_t k = 0; k < held_.size(); ++k) {
      const std::int32_t at = augmented_.state(static_cast<std::int32_t>(k));
      if (!held_[k]) diagonal[static_cast<std::size_t>(at)] = hold_states / (scales.row(at) * scales.column(at));
    }
  }
  for (std::int32_t k = 0; k < coordinates_; ++k) diagonal[static_cast<std::size_t>(k)] = hold * holding(k);
  return matrix();
}

ColumnMatrix StaticEquations::holding_matrix() const {
  std::vector<double> diagonal(static_cast<std::size_t>(augmented_.size()), 0.0);
  for (std::int32_t k = 0; k < coordinates_; ++k) diagonal[static_cast<std::size_t>(k)] = holding(k);
  const std::vector<bool> held(held_.size(), true);
  return augmented_.matrix(eq_, rows_, part_.active, {PartialBy::position, PartialBy::state, false}, {}, held,
                           diagonal);
}

ColumnMatrix StaticEquations::tangent_of_motion(double by_velocity, double by_acceleration, double by_rate,
                                                double hold) const {
  const ColumnMatrix J = tangent(hold, 0);
  std::vector<Triplet> entries;
  entries.reserve(J.value.size());
  for_each_entry(J, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
  const auto held = [&](std::int32_t r) {
    const std::int32_t k = r - augmented_.state(0);
    return k >= 0 && held_[static_cast<std::size_t>(k)];
  };
  const auto add = [&](PartialBy family, double factor, std::int32_t offset) {
    for_each_entry(eq_.matrix(family), [&](std::int32_t r, std::int32_t c, double v) {
      const std::int32_t row = augmented_.equation(r);
      if (!held(row) && !held(offset + c)) entries.push_back({row, offset + c, factor * v});
    });
  };
  add(PartialBy::velocity, by_velocity, 0);
  add(PartialBy::damping, by_velocity, 0);
  add(PartialBy::acceleration, by_acceleration, 0);
  add(PartialBy::state_rate, by_rate, augmented_.state(0));
  return compressed(J.rows, J.columns, entries);
}

Eigen::VectorXd StaticEquations::inertia(const Eigen::VectorXd& acceleration) const {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(augmented_.size());
  for_each_entry(eq_.matrix(PartialBy::acceleration),
                 [&](std::int32_t r, std::int32_t c, double v) { f(augmented_.equation(r)) += v * acceleration(c); });
  return f;
}

Eigen::VectorXd StaticEquations::forces_of_motion(const Eigen::VectorXd& velocity,
                                                  const Eigen::VectorXd& acceleration) const {
  Eigen::VectorXd f = inertia(acceleration);
  for (const PartialBy family : {PartialBy::velocity, PartialBy::damping}) {
    for_each_entry(eq_.matrix(family),
                   [&](std::int32_t r, std::int32_t c, double v) { f(augmented_.equation(r)) += v * velocity(c); });
  }
  Eigen::VectorXd balance = f.head(coordinates_);
  for_each_entry(eq_.matrix(PartialBy::algebraic), [&](std::int32_t r, std::int32_t c, double v) {
    if (r < coordinates_) balance(r) -= v * f(augmented_.algebraic(c));
  });
  return balance;
}

// The largest entry of the first tangent as force per length; one yardstick for the whole search.
void StaticEquations::measure_stiffness() {
  for_each_entry(eq_.matrix(PartialBy::position), [&](std::int32_t r, std::int32_t c, double k) {
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

}  // namespace dynalin

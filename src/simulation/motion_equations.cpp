#include "simulation/motion_equations.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynalin {

MotionEquations::MotionEquations(const System& system, Events& events, const OperatingPoint& at,
                                 std::vector<bool> active, const ErrorTolerance& tolerance)
    : system_(system),
      events_(events),
      unknowns_(system),
      active_(std::move(active)),
      tolerance_(tolerance),
      motion_(system.motion(at)),
      ahead_(motion_),
      charts_(system.layout().bodies.size()),
      differential_(unknowns_.size(), 0.0),
      largest_state_(system.layout().states.size(), 0.0) {
  const Layout& layout = system.layout();
  rows_.resize(layout);
  eq_.resize(layout);
  jacobian_.resize(static_cast<std::int32_t>(size()), static_cast<std::int32_t>(size()));
  places_.resize(static_cast<std::size_t>(layout.coordinate_count));
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    for (std::int32_t k = 0; k < layout.bodies[b].count; ++k)
      places_[static_cast<std::size_t>(layout.bodies[b].offset + k)] = {static_cast<std::int32_t>(b), k};
  }
  accept(at);
  find_differential();
  if (events_.size() > events_.switch_count()) between_.emplace(system_, motion_);
}

// Velocities without inertia and states without a rate have no error test: constraints and balances decide them.
void MotionEquations::find_differential() {
  const Layout& layout = system_.layout();
  system_.constraints(motion_, rows_);
  system_.equations(motion_, rows_, eq_, {PartialBy::acceleration, PartialBy::state_rate});
  std::fill(differential_.begin(), differential_.begin() + unknowns_.velocity(0), 1.0);
  const auto note = [&](PartialBy family, auto&& unknown) {
    for_each_entry(eq_.matrix(family), [&](std::int32_t, std::int32_t c, double v) {
      if (v != 0.0) differential_[static_cast<std::size_t>(unknown(c))] = 1.0;
    });
  };
  note(PartialBy::acceleration, [&](std::int32_t c) { return unknowns_.velocity(c); });
  note(PartialBy::state_rate, [&](std::int32_t c) { return unknowns_.state(c); });
  for (std::size_t k = 0; k < layout.states.size(); ++k) {
    if (layout.states[k].held_in_dynamics)
      differential_[static_cast<std::size_t>(unknowns_.state(static_cast<std::int32_t>(k)))] = 1.0;
  }
  const auto counted = std::count(differential_.begin(), differential_.end(), 1.0);
  if (counted > 0) dilution_ = std::sqrt(static_cast<double>(size()) / static_cast<double>(counted));
}

void MotionEquations::accept(const OperatingPoint& op) {
  motion_.mode = op.mode;
  motion_.progress = op.progress;
  motion_.memory = op.memory;
  delays_ = op.delays;
  motion_.delays = delays_.get();
  for (std::size_t k = 0; k < op.velocity.size(); ++k) {
    fastest_ = std::max(fastest_, std::abs(op.velocity[k]) / system_.coordinate_scale(static_cast<std::int32_t>(k)));
  }
  for (std::size_t k = 0; k < op.state.size(); ++k)
    largest_state_[k] = std::max(largest_state_[k], std::abs(op.state[k]));
}

bool MotionEquations::holds(std::int32_t equation_row) const {
  const auto first = eq_.state_row(0);
  return equation_row >= first &&
         system_.layout().states[static_cast<std::size_t>(equation_row - first)].held_in_dynamics;
}

void MotionEquations::evaluate(double t, std::span<const double> y, std::span<const double> yp, Partials wanted) {
  unknowns_.unpack(t, y, yp, motion_);
  system_.constraints(motion_, rows_);
  if (wanted == Partials::yes) {
    system_.equations(motion_, rows_, eq_,
                      {PartialBy::position, PartialBy::velocity, PartialBy::damping, PartialBy::acceleration,
                       PartialBy::lambda, PartialBy::algebraic, PartialBy::state, PartialBy::state_rate});
    eq_.clear_undefined();  // an iteration does without them
  } else {
    system_.equations(motion_, rows_, eq_, {});
  }
}

bool MotionEquations::residual(double t, std::span<const double> y, std::span<const double> yp, std::span<double> r) {
  evaluate(t, y, yp, Partials::no);
  kinematic_residual(y, yp, r);
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Taylor& along = rows_.along_motion(k);
    const bool position = rows_.level(k) == RowLevel::position;
    const auto lambda = static_cast<std::size_t>(unknowns_.lambda(k));
    r[lambda] = !active_[at] ? y[lambda] : position ? along.rate : along.value;
    if (!position) continue;
    const auto mu = static_cast<std::size_t>(unknowns_.mu(k));
    r[mu] = active_[at] ? along.value : y[mu];
  }
  for (std::int32_t k = 0; k < eq_.size(); ++k)
    r[static_cast<std::size_t>(unknowns_.equation(k))] = eq_.residual()[static_cast<std::size_t>(k)];
  for (std::size_t k = 0; k < system_.layout().states.size(); ++k) {
    const auto state = static_cast<std::size_t>(unknowns_.state(static_cast<std::int32_t>(k)));
    if (system_.layout().states[k].held_in_dynamics) r[state] = yp[state];
  }
  if (!std::all_of(r.begin(), r.end(), [](double v) { return std::isfinite(v); })) {
    undefined_ = system_.undefined_value(motion_);
    return false;
  }
  // What sensors watch counts as well: a step may go beyond where one has triggered and its function ends.
  if (events_.watched_is_finite(motion_)) return true;
  undefined_ = system_.domain_violation(motion_);
  return false;
}

// q′ − T(q) (u + S Φ_qᵀ μ)
void MotionEquations::kinematic_residual(std::span<const double> y, std::span<const double> yp,
                                         std::span<double> r) const {
  const Layout& layout = system_.layout();
  std::vector<double>& rate = rates_;
  rate.assign(y.begin() + unknowns_.velocity(0), y.begin() + unknowns_.lambda(0));
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    const std::int32_t mu = unknowns_.mu(k);
    if (mu < 0 || !active_[static_cast<std::size_t>(k)]) continue;
    const double m = y[static_cast<std::size_t>(mu)];
    for (const auto& e : rows_.row(k)) rate[static_cast<std::size_t>(e.column)] += metric(e.column) * e.c.g * m;
  }
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    if (block.count == 0) continue;
    const auto u = static_cast<std::size_t>(block.offset), at = static_cast<std::size_t>(unknowns_.position(b));
    for (std::size_t k = 0; k < 3; ++k) r[at + k] = yp[at + k] - rate[u + k];
    if (!block.turns()) continue;
    const auto p = static_cast<std::size_t>(unknowns_.quaternion(b));
    const Vector w{rate[u + 3], rate[u + 4], rate[u + 5]}, v{y[p + 1], y[p + 2], y[p + 3]};
    const Vector turn = 0.5 * (y[p] * w + cross(w, v));
    r[p] = yp[p] + 0.5 * dot(w, v);
    for (std::size_t k = 0; k < 3; ++k) r[p + 1 + k] = yp[p + 1 + k] - turn[k];
  }
  const auto first = static_cast<std::size_t>(layout.body_coordinate_count);
  for (std::size_t k = 0; first + k < rate.size(); ++k) {
    const auto at = static_cast<std::size_t>(unknowns_.extra(k));
    r[at] = yp[at] - rate[first + k];
  }
}

void MotionEquations::make_charts(std::span<const double> y) {
  for (std::size_t b = 0; b < charts_.size(); ++b) {
    if (!system_.layout().bodies[b].turns()) continue;
    const auto at = static_cast<std::size_t>(unknowns_.quaternion(b));
    const Vector v{y[at + 1], y[at + 2], y[at + 3]};
    const double s = y[at], factor = 2 / (s * s + dot(v, v));
    const Matrix3 cross_v = skew(v);
    Chart& chart = charts_[b];
    for (std::size_t i = 0; i < 3; ++i) {  // Gᵀ = (−v, s + [v×])
      chart.rotation[i][0] = -factor * v[i];
      for (std::size_t j = 0; j < 3; ++j) chart.rotation[i][j + 1] = factor * ((i == j ? s : 0.0) + cross_v(i, j));
    }
    const BodyMotion& body = motion_.bodies[b];
    chart.w = skew(body.w);
    chart.z = skew(body.wdot) + chart.w * chart.w;
  }
}

void MotionEquations::add_position(std::int32_t row, std::int32_t coordinate, double on_position, double on_rate,
                                   double on_acceleration) {
  const Place place = places_[static_cast<std::size_t>(coordinate)];
  if (place.body < 0) {
    jacobian_.add(row, unknowns_.extra(static_cast<std::size_t>(coordinate - system_.layout().body_coordinate_count)),
                  on_position);
    return;
  }
  const auto b = static_cast<std::size_t>(place.body);
  if (place.component < 3) {
    jacobian_.add(row, unknowns_.position(b) + place.component, on_position);
    return;
  }
  const Chart& chart = charts_[b];
  const auto i = static_cast<std::size_t>(place.component - 3);
  for (std::size_t j = 0; j < 4; ++j) {
    double sum = on_position * chart.rotation[i][j];
    for (std::size_t k = 0; k < 3; ++k)
      sum += (on_rate * chart.w(i, k) + on_acceleration * chart.z(i, k)) * chart.rotation[k][j];
    jacobian_.add(row, unknowns_.quaternion(b) + static_cast<std::int32_t>(j), sum);
  }
}

void MotionEquations::kinematic_partials(double c, std::span<const double> y) {
  const Layout& layout = system_.layout();
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    for (std::int32_t k = 0; k < std::min(block.count, 3); ++k) {
      jacobian_.add(unknowns_.position(b) + k, unknowns_.position(b) + k, c);
      jacobian_.add(unknowns_.position(b) + k, unknowns_.velocity(block.offset + k), -1.0);
    }
    if (!block.turns()) continue;
    const std::int32_t p = unknowns_.quaternion(b);
    const auto at = static_cast<std::size_t>(p);
    const Vector& w = motion_.bodies[b].w;
    const Matrix3 cross_w = skew(w), cross_v = skew(Vector{y[at + 1], y[at + 2], y[at + 3]});
    for (std::int32_t i = 0; i < 4; ++i) {  // c less the matrix of ½ (0, ω) p
      for (std::int32_t j = 0; j < 4; ++j) {
        double turn = 0;
        if (i == 0 && j > 0) turn = -w[static_cast<std::size_t>(j - 1)];
        if (i > 0 && j == 0) turn = w[static_cast<std::size_t>(i - 1)];
        if (i > 0 && j > 0) turn = cross_w(static_cast<std::size_t>(i - 1), static_cast<std::size_t>(j - 1));
        jacobian_.add(p + i, p + j, (i == j ? c : 0.0) - 0.5 * turn);
      }
      for (std::int32_t j = 0; j < 3; ++j) {
        const auto jj = static_cast<std::size_t>(j);
        const double g =
            i == 0 ? -y[at + 1 + jj] : (i - 1 == j ? y[at] : 0.0) - cross_v(static_cast<std::size_t>(i - 1), jj);
        jacobian_.add(p + i, unknowns_.velocity(block.offset + 3 + j), -0.5 * g);
      }
    }
  }
  for (std::int32_t k = layout.body_coordinate_count; k < layout.coordinate_count; ++k) {
    const std::int32_t at = unknowns_.extra(layout.extra_index(k));
    jacobian_.add(at, at, c);
    jacobian_.add(at, unknowns_.velocity(k), -1.0);
  }
}

// Constraint rows on both levels, what their multipliers exert, and what those of drift move.
void MotionEquations::row_partials(std::span<const double> y) {
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    const bool active = active_[static_cast<std::size_t>(k)];
    const std::int32_t lambda = unknowns_.lambda(k), mu = unknowns_.mu(k);
    // A zero that may be left out would be taken for a pivot where the order of elimination is chosen.
    if (!active) {
      jacobian_.add(lambda, lambda, 1.0);
      if (mu >= 0) jacobian_.add(mu, mu, 1.0);
    }
    const ConstraintRow& row = system_.layout().rows[static_cast<std::size_t>(k)];
    if (row.course >= 0) jacobian_.add(mu, unknowns_.state(row.course), active ? -1.0 : 0.0);
    if (row.course_rate >= 0) jacobian_.add(lambda, unknowns_.state(row.course_rate), active ? -1.0 : 0.0);
    for (const auto& e : rows_.row(k)) {
      const double on = active ? 1.0 : 0.0;
      const double g = on * e.c.g, v = on * e.c.v;
      jacobian_.add(unknowns_.velocity(e.column), lambda, -e.c.g);
      jacobian_.add(lambda, unknowns_.velocity(e.column), g);
      add_position(lambda, e.column, v, g, 0.0);
      if (mu < 0) continue;
      add_position(mu, e.column, g, 0.0, 0.0);
      // How μ moves positions.
      const Place place = places_[static_cast<std::size_t>(e.column)];
      const double push = metric(e.column) * g;
      if (place.body < 0) {
        jacobian_.add(unknowns_.extra(static_cast<std::size_t>(e.column - system_.layout().body_coordinate_count)), mu,
                      -push);
        continue;
      }
      const auto b = static_cast<std::size_t>(place.body);
      if (place.component < 3) {
        jacobian_.add(unknowns_.position(b) + place.component, mu, -push);
        continue;
      }
      // T = ½ G = |p|²/4 times the transposed chart.
      const auto at = static_cast<std::size_t>(unknowns_.quaternion(b));
      const double quarter =
          0.25 * (y[at] * y[at] + y[at + 1] * y[at + 1] + y[at + 2] * y[at + 2] + y[at + 3] * y[at + 3]);
      for (std::size_t j = 0; j < 4; ++j) {
        jacobian_.add(unknowns_.quaternion(b) + static_cast<std::int32_t>(j), mu,
                      -push * quarter * charts_[b].rotation[static_cast<std::size_t>(place.component - 3)][j]);
      }
    }
  }
}

void MotionEquations::balance_partials(double c, std::span<const double>) {
  const auto taken = [&](PartialBy family, auto&& add) {
    for_each_entry(eq_.matrix(family), [&](std::int32_t r, std::int32_t column, double value) {
      add(unknowns_.equation(r), column, holds(r) ? 0.0 : value);
    });
  };
  taken(PartialBy::position, [&](std::int32_t row, std::int32_t k, double v) { add_position(row, k, v, 0.0, 0.0); });
  for (const PartialBy family : {PartialBy::velocity, PartialBy::damping}) {
    taken(family, [&](std::int32_t row, std::int32_t k, double v) {
      jacobian_.add(row, unknowns_.velocity(k), v);
      if (places_[static_cast<std::size_t>(k)].component >= 3) add_position(row, k, 0.0, v, 0.0);
    });
  }
  taken(PartialBy::acceleration, [&](std::int32_t row, std::int32_t k, double a) {
    jacobian_.add(row, unknowns_.velocity(k), c * a);
    const Place place = places_[static_cast<std::size_t>(k)];
    if (place.component < 3) return;
    add_position(row, k, 0.0, 0.0, a);
    const auto b = static_cast<std::size_t>(place.body);
    const std::int32_t first = system_.layout().bodies[b].offset + 3;
    for (std::int32_t j = 0; j < 3; ++j) {
      jacobian_.add(row, unknowns_.velocity(first + j),
                    a * charts_[b].w(static_cast<std::size_t>(place.component - 3), static_cast<std::size_t>(j)));
    }
  });
  taken(PartialBy::lambda,
        [&](std::int32_t row, std::int32_t k, double v) { jacobian_.add(row, unknowns_.lambda(k), v); });
  taken(PartialBy::algebraic,
        [&](std::int32_t row, std::int32_t k, double v) { jacobian_.add(row, unknowns_.algebraic(k), v); });
  taken(PartialBy::state,
        [&](std::int32_t row, std::int32_t k, double v) { jacobian_.add(row, unknowns_.state(k), v); });
  taken(PartialBy::state_rate,
        [&](std::int32_t row, std::int32_t k, double v) { jacobian_.add(row, unknowns_.state(k), c * v); });
  for (std::size_t k = 0; k < system_.layout().states.size(); ++k) {
    if (!system_.layout().states[k].held_in_dynamics) continue;
    const std::int32_t at = unknowns_.state(static_cast<std::int32_t>(k));
    jacobian_.add(at, at, c);
  }
}

const ColumnMatrix* MotionEquations::jacobian(double t, double c, std::span<const double> y,
                                              std::span<const double> yp) {
  evaluate(t, y, yp, Partials::yes);
  make_charts(y);
  const auto pass = [&] {
    jacobian_.begin();
    kinematic_partials(c, y);
    row_partials(y);
    balance_partials(c, y);
  };
  const bool recorded = jacobian_.recorded();
  pass();
  if (!recorded) {
    jacobian_.finish();
    pass();
  }
  const ColumnMatrix& m = jacobian_.matrix();
  const bool finite = std::all_of(m.value.begin(), m.value.end(), [](double v) { return std::isfinite(v); });
  return finite ? &m : nullptr;
}

void MotionEquations::switches(double t, std::span<const double> y, std::span<const double> yp,
                               std::span<double> values) {
  unknowns_.unpack(t, y, yp, motion_);
  events_.values(motion_, values);
  if (!switches_watched_) std::ranges::fill(values.first(events_.switch_count()), 1.0);
  if (!between_) return;
  between_->evaluate(motion_, scratch_);
  events_.watched(motion_, values.subspan(events_.switch_count()));
}

double MotionEquations::part_to_make(const Instant& from, const Instant& to) {
  unknowns_.unpack(from.t, from.y, from.yp, motion_);
  ahead_.mode = motion_.mode, ahead_.progress = motion_.progress;
  ahead_.memory = motion_.memory, ahead_.delays = motion_.delays;
  unknowns_.unpack(to.t, to.y, to.yp, ahead_);
  StepReach reach(tolerance_.passed_over);
  system_.look_ahead(motion_, ahead_, scratch_, reach);
  return reach.share();
}

double MotionEquations::left_out_violation(const OperatingPoint& op) {
  double largest = 0;
  if (std::all_of(active_.begin(), active_.end(), [](bool a) { return a; })) return largest;
  const Motion motion = system_.motion(op);
  system_.constraints(motion, rows_);
  for (std::int32_t k = 0; k < rows_.size(); ++k) {
    if (active_[static_cast<std::size_t>(k)] || rows_.level(k) != RowLevel::position) continue;
    double scale = 0;
    for (const auto& e : rows_.row(k)) scale = std::max(scale, std::abs(e.c.g) * system_.coordinate_scale(e.column));
    if (scale > 0) largest = std::max(largest, std::abs(rows_.along_motion(k).value) / scale);
  }
  return largest;
}

}  // namespace dynalin

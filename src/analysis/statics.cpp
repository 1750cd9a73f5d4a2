#include "analysis/statics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "analysis/displace.h"
#include "analysis/saddle.h"

namespace dynalin {

namespace {

// The static equations at one point, with the scales that make their residuals comparable.
class StaticEquations {
 public:
  explicit StaticEquations(const System& system) : system_(system), saddle_(system) {
    rows_.resize(system.layout());
    eq_.resize(system.layout());
    for (const DifferentialState& z : system.layout().states) held_.push_back(z.held_in_statics);
  }

  void evaluate(const OperatingPoint& op, bool with_partials) {
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

  // Largest unbalanced force (moments by length) and the size of the forces at play.
  double imbalance() const {
    double worst = 0;
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(system_.coordinates()); ++k) {
      worst = std::max(worst, std::abs(residual_(k)) * force_unit(k));
    }
    return worst;
  }
  // The coordinate with the largest unbalanced force, or the equation that is farthest from being met.
  std::string worst() const {
    const Layout& layout = system_.layout();
    double largest = 0;
    std::string name;
    for (std::int32_t k = 0; k < layout.coordinate_count; ++k) {
      const double f = std::abs(residual_(k)) * force_unit(k);
      if (f > largest) largest = f, name = layout.coordinate_text(k);
    }
    if (!name.empty()) return name;
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(layout.states.size()); ++k) {
      const double f = std::abs(residual_(saddle_.state(k)));
      if (f > largest)
        largest = f, name = "the state of " + layout.states[static_cast<std::size_t>(k)].owner->full_text();
    }
    return name;
  }
  double force_scale() const { return force_scale_; }
  // The force that a unit in the last place of the positions makes: Σ |K| ε |q|, after an evaluation with partials.
  double rounding(const OperatingPoint& op) const {
    std::vector<double> size(system_.coordinates(), 1.0);
    const Layout& layout = system_.layout();
    for (std::size_t b = 1; b < layout.bodies.size(); ++b) {
      for (std::int32_t k = 0; k < std::min(layout.bodies[b].count, 3); ++k) {
        size[static_cast<std::size_t>(layout.bodies[b].offset + k)] = norm(op.poses[b].r);
      }
    }
    std::vector<double> force(system_.coordinates(), 0.0);
    const ColumnMatrix& K = eq_.matrix(Column::position);
    for (std::int32_t c = 0; c < K.columns; ++c) {
      for (auto k = static_cast<std::size_t>(K.start[static_cast<std::size_t>(c)]);
           k < static_cast<std::size_t>(K.start[static_cast<std::size_t>(c) + 1]); ++k) {
        if (K.row[k] < layout_coordinates())
          force[static_cast<std::size_t>(K.row[k])] += std::abs(K.value[k]) * size[static_cast<std::size_t>(c)];
      }
    }
    double worst = 0;
    for (std::size_t k = 0; k < force.size(); ++k)
      worst = std::max(worst, force[k] * force_unit(static_cast<Eigen::Index>(k)));
    return worst * std::numeric_limits<double>::epsilon();
  }

  // Sum of squares of all residuals in comparable units; forces are measured against `force`.
  double merit(double force) const {
    if (!(force > 0)) force = 1.0;
    double sum = 0;
    const auto n = static_cast<Eigen::Index>(system_.coordinates());
    for (Eigen::Index k = 0; k < residual_.size(); ++k) {
      double r = residual_(k);
      if (k < n)
        r *= force_unit(k) / force;
      else if (k < saddle_.algebraic(0))
        r /= system_.length();
      sum += r * r;
    }
    return sum;
  }

  // Takes reactions and algebraic values from  D a = F + Gᵀλ,  G a = 0,  w = e  at rest, with the metric D that
  // `tangent` holds with; the imbalance that is left, −D a, does no work on the reactions. Leaves the point as it is if
  // that fails.
  void settle(OperatingPoint& op) {
    OperatingPoint next = op;
    Eigen::VectorXd a = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(system_.coordinates()));
    const std::vector<bool> held(held_.size(), true);
    double before = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 12; ++iteration) {
      evaluate(next, true);
      std::vector<double> D(static_cast<std::size_t>(saddle_.size()), 0.0);
      for (std::size_t k = 0; k < system_.coordinates(); ++k) D[k] = holding(k);
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
    if (step_is_finite(next)) op = std::move(next);
  }

  // Work of the imbalance along a step of the coordinates, and the step's size in the metric that `tangent` holds with.
  double slope(const Eigen::VectorXd& step) const {
    const auto n = static_cast<Eigen::Index>(system_.coordinates());
    return residual_.head(n).dot(step.head(n));
  }
  double damping(const Eigen::VectorXd& step) const {
    double sum = 0;
    for (std::size_t k = 0; k < system_.coordinates(); ++k) {
      const double d = step(static_cast<Eigen::Index>(k));
      sum += holding(k) * d * d;
    }
    return sum;
  }

  const Eigen::VectorXd& residual() const { return residual_; }
  const Saddle& saddle() const { return saddle_; }
  const Partition& partition() const { return part_; }

  // Tangent with `hold` times a typical stiffness added to the coordinates, and to states if `hold_states`.
  ColumnMatrix tangent(double hold, bool hold_states) const {
    std::vector<double> diagonal(static_cast<std::size_t>(saddle_.size()), 0.0);
    for (std::size_t k = 0; k < system_.coordinates(); ++k) diagonal[k] = hold * holding(k);
    for (std::size_t k = 0; k < held_.size() && hold_states; ++k) {
      diagonal[static_cast<std::size_t>(saddle_.state(static_cast<std::int32_t>(k)))] = held_[k] ? 0.0 : 1.0;
    }
    return saddle_.matrix(eq_, rows_, part_.active, {Column::position, Column::state}, {}, held_, diagonal);
  }

 private:
  static bool step_is_finite(const OperatingPoint& op) {
    const auto finite = [](const std::vector<double>& v) {
      return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
    };
    return finite(op.lambda) && finite(op.algebraic);
  }
  // 1 for a force, 1/length for a moment.
  double force_unit(Eigen::Index k) const {
    return system_.coordinate_scale(static_cast<std::int32_t>(k)) / system_.length();
  }
  // A typical stiffness, as one for coordinate k.
  double holding(std::size_t k) const {
    const double s = system_.length() / system_.coordinate_scale(static_cast<std::int32_t>(k));
    return stiffness_ * s * s;
  }
  // The largest entry of the first tangent as force per length; one yardstick for the whole search.
  void measure_stiffness() {
    const ColumnMatrix& K = eq_.matrix(Column::position);
    for (std::int32_t c = 0; c < K.columns; ++c) {
      for (auto k = static_cast<std::size_t>(K.start[static_cast<std::size_t>(c)]);
           k < static_cast<std::size_t>(K.start[static_cast<std::size_t>(c) + 1]); ++k) {
        if (K.row[k] < layout_coordinates())
          stiffness_ = std::max(stiffness_, std::abs(K.value[k]) * force_unit(K.row[k]) * force_unit(c));
      }
    }
    if (stiffness_ == 0) stiffness_ = 1;
  }
  std::int32_t layout_coordinates() const { return system_.layout().coordinate_count; }
  void measure_forces(const OperatingPoint& op) {
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

  const System& system_;
  Saddle saddle_;
  ConstraintRows rows_;
  Equations eq_;
  Partition part_;
  std::vector<bool> held_;
  Eigen::VectorXd residual_;
  double force_scale_ = 0, stiffness_ = 0;
};

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

}  // namespace

Result<OperatingPoint> find_equilibrium(const System& system, OperatingPoint op, const StaticsOptions& options,
                                        StaticsReport& report, Findings& findings) {
  if (const auto& driven = system.layout().velocity_driven; !driven.empty()) {
    Failure f{"static analysis", "motions that prescribe a velocity or an acceleration contradict rest", {}};
    for (const ElementLabel* label : driven) f.details.push_back(label->full_text());
    return tl::unexpected(f);
  }
  op.mode = AnalysisMode::statics;
  const std::vector<double> first_state = op.state;
  const auto rest = [](OperatingPoint& p) {
    for (auto* x : {&p.velocity, &p.acceleration, &p.state_rate}) std::fill(x->begin(), x->end(), 0.0);
  };
  rest(op);
  auto assembled = assemble_position(system, std::move(op), findings);
  if (!assembled) return assembled;
  op = std::move(*assembled);
  StaticEquations equations(system);
  // Far from the solution the constraints are kept, and reactions and algebraic values are those that leave the least
  // imbalance, so that it speaks of the pose alone.
  const auto settle = [&](OperatingPoint& p) {
    Findings ignored;
    if (auto joined = assemble_position(system, p, ignored)) p = std::move(*joined);
    equations.settle(p);
  };
  settle(op);
  const Saddle& saddle = equations.saddle();
  std::vector<std::string> history;
  double force = 0, hold = 1, before = std::numeric_limits<double>::infinity();
  bool held_states = false, transient = false;
  for (int iteration = 0; iteration < options.iteration_limit; ++iteration) {
    equations.evaluate(op, true);
    findings.redundant_rows = equations.partition().redundant;
    report = {iteration, equations.imbalance()};
    // One yardstick for the whole search, or a step could pass by growing what it is measured against.
    force = std::max(force, equations.force_scale());
    const double merit = equations.merit(force);
    if (!std::isfinite(merit)) {
      const std::string reason = system.fault(system.motion(op));
      return tl::unexpected(Failure{"statics", reason.empty() ? "a force has no finite value" : reason, history});
    }
    history.push_back(fmt::format("iteration {}: imbalance {:.5e}{}", iteration, report.imbalance,
                                  transient ? " (pseudo-transient)" : ""));
    const double level = std::sqrt(merit);
    // Balanced as it stands, or at the level of rounding: accept.
    if (level <= 1e-13 && iteration == 0) break;
    if (level <= 1e-11 && level >= 0.25 * before) break;
    before = level;

    const auto solve = [&](double held) -> std::optional<Eigen::VectorXd> {
      SparseLu lu;
      bool factored = lu.factor(equations.tangent(held, held_states));
      if (!factored && !held_states) factored = (held_states = true) && lu.factor(equations.tangent(held, true));
      if (!factored) return std::nullopt;
      Eigen::MatrixXd step = -equations.residual();
      lu.solve(step);
      return Eigen::VectorXd(step.col(0));
    };
    const auto attempt = [&](const Eigen::VectorXd& step, double fraction, double allowed) {
      OperatingPoint next = moved(system, op, saddle, step, fraction, options.rotation_limit);
      if (level > 1e-6) settle(next);
      equations.evaluate(next, false);
      const double after = equations.merit(force);
      if (!(after <= allowed)) return false;
      hold *= after <= merit ? std::clamp(0.5 * std::sqrt(after / merit), 0.05, 0.5) : 2.0;
      op = std::move(next);
      system.remember(op);
      return true;
    };
    // Newton where it helps and goes downhill, so that it does not climb to an unstable equilibrium; close to the
    // solution rounding decides and its step is taken as it is.
    bool taken = false;
    if (!transient || level < 1e-3) {
      const auto step = solve(0);
      if (step && (level < 1e-6 || equations.slope(*step) < 0)) {
        for (const double fraction : {1.0, 0.5, 0.25}) {
          taken = attempt(*step, fraction, level < 1e-9 ? 4 * merit + 1e-24 : merit * (1 - 0.5 * fraction));
          if (taken) break;
          equations.evaluate(op, true);
        }
      }
      transient = !taken;
    }
    // Otherwise an implicit step of a damped motion: downhill, and as long as the linear model foretells the slope
    // along the step. Reactions do no work along it, so the slope speaks of the pose alone; the imbalance may grow on
    // the way.
    for (int k = 0; k < 20 && !taken; ++k) {
      const auto step = solve(hold);
      const double slope = step ? equations.slope(*step) : 0;
      if (step && slope < 0) {
        OperatingPoint next = moved(system, op, saddle, *step, 1.0, options.rotation_limit);
        settle(next);
        const double foretold = -hold * equations.damping(*step);
        equations.evaluate(next, false);
        const double off = std::abs(equations.slope(*step) - foretold) / -slope;
        if (off <= 0.5) {
          hold *= off < 0.1 ? 0.25 : off < 0.25 ? 0.5 : 1.0;
          op = std::move(next);
          system.remember(op);
          taken = true;
          break;
        }
      }
      hold *= 4;
      equations.evaluate(op, true);
    }
    transient = transient && hold > 1e-7;
    if (!taken) {
      equations.evaluate(op, true);
      Failure f{"statics", "no step reduces the imbalance", history};
      if (const std::string worst = equations.worst(); !worst.empty()) f.message += ", which is largest at " + worst;
      const auto names = undetermined(system, saddle, equations.tangent(0, false));
      if (!names.empty()) f.message += fmt::format("; the tangent leaves {} undetermined", fmt::join(names, ", "));
      if (const std::string reason = system.departure(system.motion(op)); !reason.empty()) f.message += "; " + reason;
      return tl::unexpected(f);
    }
  }
  equations.evaluate(op, true);
  report.imbalance = equations.imbalance();
  const bool balanced = std::sqrt(equations.merit(equations.force_scale())) <= 1e-7;
  // Stiff elements turn the rounding of positions into forces; no point is better than that.
  if (!balanced && report.imbalance > 100 * equations.rounding(op)) {
    Failure f{"statics",
              fmt::format("no equilibrium was found, the imbalance is still {:.3e}, largest at {}", report.imbalance,
                          equations.worst()),
              history};
    if (const std::string reason = system.departure(system.motion(op)); !reason.empty()) f.message += "; " + reason;
    return tl::unexpected(f);
  }
  if (held_states) {
    // A pure integrator that balances at its first value keeps it.
    OperatingPoint kept = op;
    kept.state = first_state;
    equations.evaluate(kept, false);
    if (std::sqrt(equations.merit(equations.force_scale())) < 1e-9) op = std::move(kept);
  }
  return op;
}

Result<OperatingPoint> static_operating_point(const System& system, OperatingPoint start, const StaticsOptions& options,
                                              StaticsReport& report, Findings& findings) {
  auto op = find_equilibrium(system, std::move(start), options, report, findings);
  if (op && op->time == 0 && !std::getenv("MSC_ADAMS_STATICS_NO_RESTORE_VELOCITIES"))
    op = initial_velocity(system, std::move(*op), findings);
  if (op) op = reconcile_velocity(system, std::move(*op), findings);
  if (op) op = solve_acceleration(system, std::move(*op), findings);
  return op;
}

}  // namespace dynalin

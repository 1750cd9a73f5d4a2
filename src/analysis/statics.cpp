#include "analysis/statics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/continuation.h"
#include "analysis/least_imbalance.h"
#include "analysis/static_equations.h"
#include "analysis/static_refusal.h"

namespace dynalin {

namespace {

// Beyond all proportion to the model: balance is an illusion of forces that vanish or grow without end.
bool escaped(const System& system, const OperatingPoint& from, const OperatingPoint& to) {
  constexpr double far = 1e6;
  double largest = 0;
  for (std::size_t b = 1; b < to.poses.size(); ++b) largest = std::max(largest, norm(to.poses[b].r - from.poses[b].r));
  return !(largest <= far * system.length());
}

// Iterations after which a motion that has come no closer to rest goes round in a circle or away.
constexpr int patience = 80;

// One way downhill from a point: Newton where it helps, else implicit steps of a damped motion.
class Descent {
 public:
  Descent(StaticEquations& equations, const StaticsOptions& options, std::vector<std::string>& history)
      : equations_(equations), system_(equations.system()), options_(options), history_(history) {}

  // Whether it came to rest; `op` is the last point in any case.
  bool run(OperatingPoint& op) {
    for (iteration_ = 0; iteration_ < options_.iteration_limit; ++iteration_) {
      equations_.evaluate(op, true);
      // One yardstick for the whole search, or a step could pass by growing what it is measured against.
      force_ = std::max(force_, equations_.force_scale());
      merit_ = equations_.merit(force_);
      if (!std::isfinite(merit_)) return false;
      history_.push_back(fmt::format("iteration {}: imbalance {:.5e}{}", history_.size(), equations_.imbalance(),
                                     transient_ ? " (pseudo-transient)" : ""));
      if (iteration_ == 0) first_ = op, first_force_ = force_;
      if (escaped(system_, first_, op)) return false;
      // Against the first yardstick: forces that grow without end do not make a point better.
      const double merit = equations_.merit(first_force_);
      if (merit < 0.8 * lowest_merit_) improved_ = iteration_;
      if (merit < lowest_merit_) lowest_merit_ = merit, lowest_ = op;
      if (iteration_ > improved_ + patience) return false;
      const double level = std::sqrt(merit_);
      // Balanced as it stands, or at the level of rounding: accept.
      if (level <= 1e-13 && iteration_ == 0) return true;
      if (level <= 1e-11 && level >= 0.25 * before_) return true;
      // Stiff elements turn the rounding of positions into forces: no point is better than that.
      const bool stalls = level >= 0.25 * before_ && equations_.imbalance() <= 100 * equations_.rounding(op);
      stalled_ = stalls ? stalled_ + 1 : 0;
      if (stalled_ == 3) return true;
      before_ = level;
      if (newton(op, level)) continue;
      if (!implicit(op)) return false;
      transient_ = hold_ > 1e-7;
    }
    return false;
  }

  const OperatingPoint& lowest() const { return lowest_; }
  bool held_states() const { return held_states_; }

 private:
  std::optional<Eigen::VectorXd> solve(double hold) {
    SparseLu lu;
    bool factored = lu.factor(equations_.tangent(hold, held_states_));
    if (!factored && !held_states_) factored = (held_states_ = true) && lu.factor(equations_.tangent(hold, true));
    if (!factored) return std::nullopt;
    Eigen::MatrixXd step = -equations_.residual();
    lu.solve(step);
    return Eigen::VectorXd(step.col(0));
  }

  // Where it goes downhill, so that it does not climb to an unstable equilibrium; close to the solution rounding
  // decides and the step is taken as it is.
  bool newton(OperatingPoint& op, double level) {
    if (transient_ && level >= 1e-3) return false;
    transient_ = true;
    const auto step = solve(0);
    if (!step || (level >= 1e-6 && equations_.slope(*step) >= 0)) return false;
    for (const double fraction : {1.0, 0.5, 0.25}) {
      OperatingPoint next = moved(system_, op, equations_.saddle(), *step, fraction, options_.rotation_limit);
      if (level > 1e-6) equations_.settle(next);
      equations_.evaluate(next, false);
      const double after = equations_.merit(force_);
      if (after <= (level < 1e-9 ? 4 * merit_ + 1e-24 : merit_ * (1 - 0.5 * fraction))) {
        hold_ *= after <= merit_ ? std::clamp(0.5 * std::sqrt(after / merit_), 0.05, 0.5) : 2.0;
        op = std::move(next);
        system_.remember(op);
        transient_ = false;
        return true;
      }
    }
    equations_.evaluate(op, true);
    return false;
  }

  // An implicit step of a damped motion: downhill, and as long as the linear model foretells the slope along the step.
  // Reactions do no work along it, so the slope speaks of the pose alone; the imbalance may grow on the way.
  bool implicit(OperatingPoint& op) {
    for (int k = 0; k < 20; ++k) {
      const auto step = solve(hold_);
      const double slope = step ? equations_.slope(*step) : 0;
      if (step && slope < 0) {
        OperatingPoint next = moved(system_, op, equations_.saddle(), *step, 1.0, options_.rotation_limit);
        equations_.settle(next);
        const double foretold = -hold_ * equations_.damping(*step);
        equations_.evaluate(next, false);
        const double off = std::abs(equations_.slope(*step) - foretold) / -slope;
        if (off <= 0.5 && equations_.residual().allFinite()) {
          hold_ *= off < 0.1 ? 0.25 : off < 0.25 ? 0.5 : 1.0;
          op = std::move(next);
          system_.remember(op);
          return true;
        }
      }
      hold_ *= 4;
      equations_.evaluate(op, true);
    }
    return false;
  }

  StaticEquations& equations_;
  const System& system_;
  const StaticsOptions& options_;
  std::vector<std::string>& history_;
  int iteration_ = 0, improved_ = 0, stalled_ = 0;
  OperatingPoint first_, lowest_;
  double first_force_ = 0, lowest_merit_ = std::numeric_limits<double>::infinity();
  double force_ = 0, merit_ = 0, hold_ = 1, before_ = std::numeric_limits<double>::infinity();
  bool held_states_ = false, transient_ = false;
};

// At rest to 1e-7 of the forces at play. Stiff elements turn the rounding of positions into forces; no point is better
// than that.
bool at_rest(StaticEquations& equations, const OperatingPoint& op) {
  equations.evaluate(op, true);
  if (std::sqrt(equations.merit(equations.force_scale())) <= 1e-7) return true;
  return equations.imbalance() <= 100 * equations.rounding(op) &&
         std::sqrt(equations.merit(std::numeric_limits<double>::infinity())) <= 1e-7;
}

// Another place to begin: every part turned and moved, every state changed, at most as far as the model is long, a
// radian or one; the same places in every run.
OperatingPoint elsewhere(const System& system, OperatingPoint op, int k) {
  std::mt19937_64 bits(static_cast<std::uint64_t>(k));
  const auto draw = [&](double size) { return size * (std::ldexp(static_cast<double>(bits() >> 11), -52) - 1); };
  const double size = k % 2 ? 0.3 : 1.0;
  for (std::size_t b = 1; b < op.poses.size(); ++b) {
    Vector shift, turn;
    for (std::size_t c = 0; c < 3; ++c) shift[c] = draw(size * system.length()), turn[c] = draw(3 * size);
    op.poses[b].r += shift;
    op.poses[b].R = orthonormalized(rotation_exponential(turn) * op.poses[b].R);
  }
  for (double& z : op.state) z += draw(3 * size);
  return op;
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
  for (auto* x : {&op.velocity, &op.acceleration, &op.state_rate}) std::fill(x->begin(), x->end(), 0.0);
  auto assembled = assemble_position(system, std::move(op), findings);
  if (!assembled) return assembled;
  op = std::move(*assembled);

  StaticEquations equations(system);
  std::vector<std::string> history;
  Descent descent(equations, options, history);
  equations.settle(op);
  const OperatingPoint drawn = op;
  bool found = descent.run(op);
  const OperatingPoint lowest = descent.lowest();
  if (!found) {
    // What nothing holds at the first point, at the best and at the last is held nowhere.
    const auto unheld = unheld_parts(equations, drawn);
    if (!unheld.empty() && unheld == unheld_parts(equations, lowest) && unheld == unheld_parts(equations, op)) {
      report = {static_cast<int>(history.size()), equations.imbalance()};
      return tl::unexpected(static_refusal(equations, lowest, std::move(history)));
    }
  }
  for (const OperatingPoint* start : {&lowest, &drawn}) {
    if (found) break;
    OperatingPoint least = *start;
    if (reduce_imbalance(equations, least, 100)) {
      op = std::move(least);
      found = Descent(equations, options, history).run(op) && !escaped(system, drawn, op);
    }
  }
  for (const OperatingPoint* start : {&lowest, &drawn}) {
    for (const bool forward : {true, false}) {
      if (found) break;
      if (auto rest = follow_to_rest(equations, *start, forward)) {
        op = std::move(*rest);
        found = Descent(equations, options, history).run(op) && !escaped(system, drawn, op);
      }
    }
  }
  for (int k = 0; k < options.restarts && !found; ++k) {
    OperatingPoint other = elsewhere(system, drawn, k);
    if (reduce_imbalance(equations, other, 60)) {
      op = std::move(other);
      found = Descent(equations, options, history).run(op) && !escaped(system, drawn, op);
    }
  }
  report.iterations = std::max(0, static_cast<int>(history.size()) - 1);
  if (escaped(system, drawn, op) || !at_rest(equations, op)) {
    report.imbalance = equations.imbalance();
    return tl::unexpected(static_refusal(equations, lowest, std::move(history)));
  }
  report.imbalance = equations.imbalance();
  findings.redundant_rows = equations.partition().redundant;
  if (descent.held_states()) {
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
  if (op) report.at_rest = *op;
  if (op && op->time == 0 && options.restore_velocities) op = initial_velocity(system, std::move(*op), findings);
  if (op) op = reconcile_velocity(system, std::move(*op), findings);
  if (op) op = solve_acceleration(system, std::move(*op), findings);
  return op;
}

}  // namespace dynalin

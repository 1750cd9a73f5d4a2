#include "analysis/damped_motion.h"

#include <algorithm>
#include <cmath>

#include "analysis/balance.h"
#include "analysis/settled_reactions.h"
#include "analysis/static_step.h"

namespace dynalin {

namespace {

constexpr double first_way = 0.02;              // of the first step, in model lengths or radians
constexpr StepLimits longest_step{0.3, 1e300};  // of a step; translations are limited by the length of the model
constexpr double hold = 1e-12;                  // of a typical stiffness: what has neither mass nor stiffness
constexpr int most_steps = 600;
constexpr int motion_patience = 120;  // steps without coming closer to rest

class Relaxation {
 public:
  Relaxation(StaticEquations& equations, const DampedMotion& options)
      : equations_(equations),
        system_(equations.system()),
        options_(options),
        coordinates_(static_cast<Eigen::Index>(equations.system().coordinates())) {
    equations_.measure_by(Yardstick::model);
    equations_.look_at_motion();
  }

  bool run(OperatingPoint& op, StaticHistory& history, double effort_limit,
           const std::function<bool(OperatingPoint&)>& at_rest) {
    settle(equations_, op);
    velocity_ = Eigen::VectorXd::Zero(coordinates_);
    int improved = 0, asked = -1;
    double lowest = std::numeric_limits<double>::infinity(), force = 0;
    for (int k = 0; k < most_steps && k <= improved + motion_patience; ++k) {
      if (equations_.effort() > effort_limit) return false;
      equations_.evaluate(op, Partials::yes);
      force = std::max(force, equations_.force_scale());
      const double level = std::sqrt(equations_.merit(force));
      history.add(equations_.imbalance_of_functions(), equations_.rate_of_states());
      if (!std::isfinite(level)) return false;
      if (level < 0.9 * lowest) lowest = level, improved = k;
      const bool slow =
          k > 0 && acceleration_ <= options_.acceleration_error && energy_ <= options_.kinetic_energy_error;
      if ((level <= force_balance || (slow && level <= 1e-3)) && k > asked) {
        asked = k + (level <= force_balance ? 0 : 4);
        OperatingPoint here = op;
        if (at_rest(here)) {
          op = std::move(here);
          return true;
        }
        equations_.evaluate(op, Partials::yes);
      }
      if (time_ > options_.longest_time || !step(op)) return false;
    }
    return false;
  }

 private:
  // As far as the first step may go under the forces as they are, if nothing but mass resists.
  void choose_step() {
    step_ = 1;
    for (int k = 0; k < 80; ++k) {
      const auto d = solve();
      const double way = d ? reach(*d) : 0;
      if (d && way <= first_way && way >= first_way / 64) return;
      step_ *= !d || way > first_way ? 0.25 : 2;
    }
  }

  double reach(const Eigen::VectorXd& d) const {
    double largest = 0;
    for (Eigen::Index k = 0; k < coordinates_; ++k)
      largest = std::max(largest, std::abs(d(k)) / system_.coordinate_scale(static_cast<std::int32_t>(k)));
    return largest;
  }

  std::optional<Eigen::VectorXd> solve() {
    const double h = step_;
    ColumnMatrix J = equations_.tangent_of_motion(1 / h, 1 / (h * h), 1 / h, hold);
    if (options_.global_damping > 0) {
      std::vector<Triplet> entries;
      for_each_entry(J, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
      for (Eigen::Index k = 0; k < coordinates_; ++k) {
        const auto i = static_cast<std::int32_t>(k);
        entries.push_back({i, i, global(i) / h});
      }
      J = compressed(J.rows, J.columns, entries);
    }
    Eigen::MatrixXd x = -equations_.residual() + equations_.inertia(velocity_) / h;
    if (!equations_.factor(lu_, std::move(J))) return std::nullopt;
    lu_.solve(x);
    if (!x.allFinite()) return std::nullopt;
    return Eigen::VectorXd(x.col(0));
  }

  // Moments by the square of the length of the model.
  double global(std::int32_t k) const {
    const double s = system_.length() / system_.coordinate_scale(k);
    return options_.global_damping * s * s;
  }

  bool step(OperatingPoint& op) {
    if (step_ == 0) choose_step();
    for (int k = 0; k < 40; ++k) {
      const auto d = solve();
      if (d) {
        StepLimits limits = longest_step;
        limits.translation = 0.5 * system_.length();
        const double before = equations_.slope(*d), motion = work_of_motion(*d);
        // A step so long that masses do not hold it against a stiffness that is negative goes the wrong way.
        const double driving =
            before - equations_.inertia(velocity_).head(coordinates_).dot(d->head(coordinates_)) / step_;
        if (driving >= 0 && reach(*d) > 1e-6) {
          step_ *= 0.3;
          continue;
        }
        double taken = 0;
        OperatingPoint next = moved(system_, op, equations_.augmented(), *d, 1.0, limits, &taken);
        settle(equations_, next);
        const Eigen::VectorXd u = taken / step_ * d->head(coordinates_);
        const Eigen::VectorXd a = (u - velocity_) / step_;
        const double foretold = before + taken * (motion - before);
        const double energy = 0.5 * u.dot(equations_.inertia(u).head(coordinates_));
        equations_.evaluate(next, Partials::no);
        const double after = equations_.slope(*d);
        const double off = std::abs(after - foretold) / std::max({std::abs(before), std::abs(foretold), 1e-300});
        if (equations_.residual().allFinite() && (off <= 0.5 || reach(*d) < 1e-6)) {
          // Forces that oppose the motion: beyond the peak of kinetic energy.
          const bool passed = energy < energy_ || after > 0;
          time_ += step_;
          acceleration_ = a.size() > 0 ? a.cwiseAbs().maxCoeff() : 0.0;
          energy_ = passed ? 0.0 : energy;
          velocity_ = passed ? Eigen::VectorXd(Eigen::VectorXd::Zero(coordinates_)) : u;
          if (taken == 1.0) step_ *= off < 0.05 ? 3.0 : off < 0.2 ? 1.5 : 1.0;
          op = std::move(next);
          system_.remember(op);
          return true;
        }
      }
      step_ *= 0.3;
      equations_.evaluate(op, Partials::yes);
    }
    return false;
  }

  // The work of the imbalance along the step after it, as the linear model has it: what motion takes of it.
  double work_of_motion(const Eigen::VectorXd& d) const {
    const Eigen::VectorXd way = d.head(coordinates_), u = way / step_;
    Eigen::VectorXd f = equations_.forces_of_motion(u, (u - velocity_) / step_);
    for (Eigen::Index k = 0; k < coordinates_; ++k) f(k) += global(static_cast<std::int32_t>(k)) * u(k);
    return -f.dot(way);
  }

  StaticEquations& equations_;
  const System& system_;
  const DampedMotion& options_;
  Eigen::Index coordinates_;
  SparseLu lu_;
  Eigen::VectorXd velocity_;
  double step_ = 0, time_ = 0, energy_ = 0, acceleration_ = 0;
};

}  // namespace

bool relax_by_motion(StaticEquations& equations, OperatingPoint& op, const DampedMotion& options,
                     StaticHistory& history, double effort_limit, const std::function<bool(OperatingPoint&)>& at_rest) {
  return Relaxation(equations, options).run(op, history, effort_limit, at_rest);
}

}  // namespace dynalin

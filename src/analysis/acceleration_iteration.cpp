#include "analysis/acceleration_iteration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "analysis/acceleration_corrections.h"
#include "analysis/acceleration_rounding.h"
#include "analysis/augmented_system.h"
#include "analysis/undetermined_reactions.h"
#include "mechanics/vanishing_source.h"
#include "system/sources.h"

namespace dynalin {

namespace {

constexpr std::int64_t acceleration_iterations = 100;  // unless IC states AMAXIT
// Solutions with undefined equations held, after which a reason is named.
constexpr int held_limit = 5;
constexpr int halving_limit = 40;
// Steps of which none is shorter than a part of all before them have met a rounding that no sum of terms shows, inside
// an expression. A root of ninefold multiplicity still comes closer than that.
constexpr int search_patience = 8;
constexpr double search_progress = 0.4;
// Of the largest unknown that there was: next to nothing. What is zero but started as such has next to no terms either,
// and would go on to vanish without end.
constexpr double next_to_nothing = 1e-60;
// Of an unknown, or of its known rounding: what such steps may be for the point to count as found.
constexpr double largest_hidden_rounding = 1e-6, hidden_units = 1e3;
// Of the largest unknown, the same: what a sum of forces that cancel leaves of a ball's spin is beneath its own digits.
constexpr double hidden_remainder = 1e-32;

// The algebraic or differential equation that is farthest from being met, relative to its own terms; empty if all are.
std::string farthest_equation(const Layout& layout, const Equations& eq) {
  std::string name;
  double worst = 0, farthest = 0;
  const auto look = [&](std::int32_t row, const ElementLabel& owner) {
    constexpr double met = 1e-6, alike = 0.1;
    const auto at = static_cast<std::size_t>(row);
    const double left = std::abs(eq.residual()[at]), relative = left / std::max(eq.magnitude()[at], 1e-300);
    // Of those that are not met alike the one with the largest residual: what is rounding of nothing says least.
    if (relative <= met || relative < alike * worst || (alike * relative < worst && left < farthest)) return;
    worst = std::max(worst, relative), farthest = left, name = owner.full_text();
  };
  for (std::size_t k = 0; k < layout.algebraic.size(); ++k)
    look(eq.algebraic_row(static_cast<std::int32_t>(k)), *layout.algebraic[k].owner);
  for (std::size_t k = 0; k < layout.states.size(); ++k)
    look(eq.state_row(static_cast<std::int32_t>(k)), *layout.states[k].owner);
  return name;
}

bool same(const ColumnMatrix& a, const ColumnMatrix& b) {
  return a.value == b.value && a.row == b.row && a.start == b.start;
}

// Steps in units of those that count as none; 0/0 is none.
double longest(const Eigen::VectorXd& step, const Eigen::VectorXd& unit) {
  double ratio = 0;
  for (Eigen::Index k = 0; k < step.size(); ++k) {
    if (step(k) != 0) ratio = std::max(ratio, std::abs(step(k)) / unit(k));
  }
  return ratio;
}

// Decides by the steps of Newton's method, each measured in what rounding makes of its own unknown, when to stop.
class StepLength {
 public:
  // `start` are the unknowns that the iteration begins with.
  explicit StepLength(const Eigen::VectorXd& start) : largest_(start.lpNorm<Eigen::Infinity>()) {}

  // `rounding` is that of the solution, and grows where steps show more. Near a multiple root steps shrink slowly, and
  // they count until rounding makes them.
  bool settled(const Eigen::VectorXd& step, Eigen::VectorXd& rounding, const Eigen::VectorXd& size,
               const std::function<Eigen::VectorXd()>& rounding_of_point) {
    constexpr double unit = 4 * std::numeric_limits<double>::epsilon();
    largest_ = std::max(largest_, size.lpNorm<Eigen::Infinity>());
    Eigen::VectorXd allowed = rounding.cwiseMax(unit * size).cwiseMax(next_to_nothing * largest_);
    double now = longest(step, allowed);
    if (now > 1 && now > 0.1 * last_) {
      allowed = allowed.cwiseMax(rounding_units_of_step * rounding_of_point());
      now = longest(step, allowed);
    }
    last_ = now;
    if (now <= 1) return true;
    steps_.push_back(now);
    const auto recent = static_cast<std::ptrdiff_t>(search_patience);
    if (std::ssize(steps_) <= recent) return false;
    const double before = *std::min_element(steps_.begin(), steps_.end() - recent);
    const double since = *std::min_element(steps_.end() - recent, steps_.end());
    const Eigen::VectorXd most = (largest_hidden_rounding * size)
                                     .cwiseMax(hidden_units * allowed)
                                     .cwiseMax(hidden_remainder * size.lpNorm<Eigen::Infinity>());
    if (since <= search_progress * before || longest(step, most) > 1) return false;
    rounding = rounding.cwiseMax(step.cwiseAbs());
    return true;
  }
  double last() const { return last_; }

 private:
  double last_ = std::numeric_limits<double>::infinity(), largest_;
  std::vector<double> steps_;
};

class AccelerationIteration {
 public:
  AccelerationIteration(const System& system, AccelerationEquations& equations, OperatingPoint op,
                        AccelerationStart start, AccelerationSteps steps)
      : system_(system),
        equations_(equations),
        start_(start),
        steps_(steps),
        stated_limit_(op.initial_conditions.acceleration_iteration_limit),
        most_(stated_limit_.value_or(acceleration_iterations)),
        op_(std::move(op)),
        length_(equations.values(op_)),
        rounding_is_known_(!has_source<VanishingSource>(system)) {}

  tl::expected<AccelerationSolution, Failure> run() {
    for (std::int64_t iteration = 0; iteration < most_; ++iteration) {
      auto here = linearized(iteration);
      if (!here) return tl::unexpected(here.error());
      if (!here->is_finite()) {
        if (!regular_ || halved_++ >= halving_limit) return without_finite_value(system_, op_, history_);
        if (halved_ == 1) ran_into_ = system_.undefined_value(system_.motion(op_));
        go_half_as_far();
        continue;
      }
      regular_ = !here->holds;
      if (halved_ == 0) ran_into_.clear();
      halved_ = 0;
      step_ = here->right;
      const bool one_step = steps_ == AccelerationSteps::one_if_linear && !undefined_ && equations_.linear();
      if (auto factored = factor(std::move(here->matrix), one_step); !factored) return tl::unexpected(factored.error());
      found_.lu.solve(step_);
      const bool done = one_step || (iteration > 0 && regular_ && settles(iteration));
      if (!done) regular_point_ = op_;
      equations_.move(op_, step_.col(0));
      if (!done) continue;
      found_.op = std::move(op_);
      return std::move(found_);
    }
    return not_converged();
  }

 private:
  // The equations about a point; some unknowns may be held where they are.
  struct Linearized {
    ColumnMatrix matrix;
    Eigen::VectorXd right;
    bool holds = false;

    bool is_finite() const {
      return right.allFinite() &&
             std::all_of(matrix.value.begin(), matrix.value.end(), [](double v) { return std::isfinite(v); });
    }
  };

  tl::expected<Linearized, Failure> linearized(std::int64_t iteration) {
    equations_.release();
    if (auto looked = equations_.look_at_massless(op_); !looked) {
      const std::string reason = system_.domain_violation(system_.motion(op_));
      return tl::unexpected(reason.empty() ? looked.error() : acceleration_failure(reason, "undefined-value").value());
    }
    Linearized here;
    here.right = equations_.evaluate(op_, AccelerationEquations::unknowns);
    if (iteration == 0 && start_ == AccelerationStart::reactions_held) {
      here.holds = equations_.hold_reactions(here.right);
      if (!here.holds) return acceleration_failure("no force depends on reactions", "unsolved-equations");
    }
    if (!regular_ && held_++ < held_limit) here.holds = equations_.hold_undefined(here.right) || here.holds;
    // Partials without a finite value: the iteration does without them, and names them if it fails.
    if (!here.holds) undefined_ = equations_.clear_undefined();
    here.matrix = equations_.matrix();
    return here;
  }

  void go_half_as_far() {
    step_ *= 0.5;
    op_ = regular_point_;
    equations_.move(op_, step_.col(0));
  }

  tl::expected<void, Failure> factor(ColumnMatrix matrix, bool one_step) {
    if (same(matrix, found_.factored)) return {};
    found_.linear = found_.linear && found_.factored.value.empty();
    if (!one_step) found_.factored = matrix;
    if (found_.lu.factor(std::move(matrix))) return {};
    return undetermined_accelerations();
  }

  // Whether this step is the last. It may be that of a second solution, by what the first told of rounding.
  bool settles(std::int64_t iteration) {
    found_.terms = equations_.terms(found_.factored, op_);
    Eigen::VectorXd rounding = rounding_of_solution(found_.lu, found_.terms), size = equations_.values(op_).cwiseAbs();
    equations_.spread_over_axes(rounding);
    const auto rounding_of_point = [&] {
      return rounding_of_accelerations(system_, found_.lu, op_, [&](const OperatingPoint& at) -> Eigen::VectorXd {
        return equations_.evaluate(at, {});
      });
    };
    const bool settled = length_.settled(step_.col(0), rounding, size, rounding_of_point);
    history_.push_back(fmt::format("iteration {}: longest step {:.3e} times its rounding", iteration, length_.last()));
    if (!settled) return false;
    if (!rounding_is_known_ && iteration + 1 < most_) {
      constexpr double margin = 4;  // what lost_digits looks at beside the solution is zero as well
      const auto rows = static_cast<Eigen::Index>(op_.lambda.size());
      const std::int32_t first = equations_.augmented().lambda(0);
      take_rounding(system_, margin * rounding.cwiseMax(rounding_of_point()).segment(first, rows), op_);
      rounding_is_known_ = true;
      return false;
    }
    found_.settled = true;
    found_.uncertainty = std::move(rounding);
    return true;
  }

  tl::unexpected<Failure> undetermined_accelerations() const {
    if (undefined_) {
      if (const std::string reason = system_.undefined_value(system_.motion(op_)); !reason.empty())
        return acceleration_failure(reason, "undefined-value");
    }
    if (const std::string reason = system_.domain_violation(system_.motion(op_)); !reason.empty())
      return acceleration_failure(reason, "undefined-value");
    const std::vector<std::string> free = undetermined(system_, equations_.augmented(), equations_.augmented_matrix());
    std::string named = free.empty() ? "" : fmt::format(": nothing fixes {}", fmt::join(free, ", "));
    const auto is_value = [](const std::string& name) { return name.starts_with("the value of "); };
    if (!free.empty() && std::ranges::all_of(free, is_value))
      named += free.size() > 1 ? "; the functions read each other, and contradict each other or agree on any value"
                               : "; the function reads itself, and no value agrees with it, or any does";
    return acceleration_failure("the accelerations are not determined" + named, "undetermined-accelerations", free);
  }

  tl::unexpected<Failure> not_converged() {
    if (!ran_into_.empty()) {
      return acceleration_failure(ran_into_ + "; the iteration for accelerations comes back to where that is",
                                  "undefined-value", history_);
    }
    if (undefined_) {
      if (const std::string reason = system_.undefined_value(system_.motion(op_)); !reason.empty()) {
        return acceleration_failure(
            reason +
                "; without it the iteration for accelerations does not settle, and there may be none that "
                "meet all equations",
            "undefined-value", history_);
      }
    }
    if (stated_limit_) history_.insert(history_.begin(), fmt::format("IC allows {} iterations (AMAXIT)", most_));
    equations_.evaluate(op_, {});
    const std::string name = farthest_equation(system_.layout(), equations_.equations());
    return acceleration_failure(
        "the equations for accelerations, reactions and algebraic values did not converge, and there may be "
        "none that meet all equations" +
            (name.empty() ? "" : "; farthest from being met is the equation of " + name),
        "unsolved-equations", history_);
  }

  const System& system_;
  AccelerationEquations& equations_;
  const AccelerationStart start_;
  const AccelerationSteps steps_;
  const std::optional<std::int64_t> stated_limit_;
  const std::int64_t most_;  // iterations
  OperatingPoint op_, regular_point_;
  Eigen::MatrixXd step_;
  AccelerationSolution found_;
  StepLength length_;
  bool regular_ = false;  // an earlier point was
  bool undefined_ = false;
  int held_ = 0, halved_ = 0;
  std::string ran_into_;  // what has no value where the step before this one led, if it had to be shortened
  // A solution tells what rounding makes of reactions; sizes that are no more are zero in the one after it.
  bool rounding_is_known_;
  std::vector<std::string> history_;
};

}  // namespace

tl::unexpected<Failure> acceleration_failure(std::string message, std::string_view code,
                                             std::vector<std::string> details) {
  return tl::unexpected(Failure{"acceleration initial conditions", std::move(message), std::move(details), code});
}

tl::unexpected<Failure> without_finite_value(const System& system, const OperatingPoint& op,
                                             std::vector<std::string> details) {
  std::string reason = system.undefined_value(system.motion(op));
  if (reason.empty()) reason = "a force or constraint has no finite value";
  return acceleration_failure(std::move(reason), "undefined-value", std::move(details));
}

void take_rounding(const System& system, const Eigen::VectorXd& of_multipliers, OperatingPoint& op) {
  for_each_source<VanishingSource>(system, [&](const ElementSet&, const VanishingSource& source) {
    source.take_rounding(system.motion(op), {of_multipliers.data(), op.lambda.size()}, op.memory);
  });
}

tl::expected<AccelerationSolution, Failure> iterate_accelerations(const System& system,
                                                                  AccelerationEquations& equations, OperatingPoint op,
                                                                  AccelerationStart start, AccelerationSteps steps) {
  return AccelerationIteration(system, equations, std::move(op), start, steps).run();
}

}  // namespace dynalin

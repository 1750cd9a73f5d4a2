#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "analysis/acceleration_checks.h"
#include "analysis/acceleration_corrections.h"
#include "analysis/acceleration_equations.h"
#include "analysis/acceleration_rounding.h"
#include "analysis/augmented_system.h"
#include "analysis/contradiction.h"
#include "analysis/initial.h"
#include "analysis/undetermined_reactions.h"
#include "mechanics/vanishing_source.h"
#include "system/sources.h"
#include "system/undefined_rows.h"

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
// Of a derivative: lost digits worth a warning, and so many that no derivative is left.
constexpr double material_loss = 1e-9, loss_of_all = 0.1;

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

// A value that began as the dataset states it and ends elsewhere; a static solution begins where it has moved it.
void warn_of_changed_starts(const Layout& layout, const std::vector<double>& before, const std::vector<double>& after,
                            Findings& findings) {
  for (std::size_t k = 0; k < layout.algebraic.size(); ++k) {
    const AlgebraicUnknown& a = layout.algebraic[k];
    const double change = std::abs(after[k] - a.guess), size = std::max(std::abs(a.guess), std::abs(after[k]));
    if (!a.guess_is_start || before[k] != a.guess || change <= 1e-9 * size) continue;
    findings.warnings.warning("changed-start", a.owner->at,
                              fmt::format("the initial value {:g} of {} contradicts the condition it follows from: it "
                                          "starts at {:.9g}",
                                          a.guess, a.owner->full_text(), after[k]));
  }
}

tl::unexpected<Failure> failure(std::string message, std::string_view code, std::vector<std::string> details = {}) {
  return tl::unexpected(Failure{"acceleration initial conditions", std::move(message), std::move(details), code});
}

// What an iteration leaves behind.
struct Solution {
  OperatingPoint op;
  SparseLu lu;
  bool settled = false;         // else corrections have to show that the first step was all
  ColumnMatrix factored;        // from the second step on
  bool linear = true;           // every point had the same matrix
  Eigen::VectorXd terms;        // of each equation
  Eigen::VectorXd uncertainty;  // of each unknown
};

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

// At λ = 0 a force of reactions may have no derivative: it waits until the others have made reactions.
enum class Start : std::uint8_t { undefined_held, reactions_held };
// Linear equations are solved by one step, but for roundings.
enum class Steps : std::uint8_t { one_if_linear, until_settled };

void take_rounding(const System& system, const Eigen::VectorXd& of_multipliers, OperatingPoint& op) {
  for_each_source<VanishingSource>(system, [&](const ElementSet&, const VanishingSource& source) {
    source.take_rounding(system.motion(op), {of_multipliers.data(), op.lambda.size()}, op.memory);
  });
}

tl::expected<Solution, Failure> iterate(const System& system, AccelerationEquations& equations, OperatingPoint op,
                                        Start start, Steps steps) {
  const AugmentedSystem& augmented = equations.augmented();
  std::vector<std::string> history;
  Solution found;
  OperatingPoint regular_point;
  Eigen::MatrixXd step;
  bool regular = false;  // an earlier point was
  bool undefined = false;
  int held = 0, halved = 0;
  StepLength length(equations.values(op));
  // A solution tells what rounding makes of reactions; sizes that are no more are zero in the one after it.
  bool rounding_is_known = !has_source<VanishingSource>(system);
  const auto stated_limit = op.initial_conditions.acceleration_iteration_limit;
  const std::int64_t most = stated_limit.value_or(acceleration_iterations);
  for (std::int64_t iteration = 0; iteration < most; ++iteration) {
    equations.release();
    if (auto looked = equations.look_at_massless(op); !looked) {
      const std::string reason = system.domain_violation(system.motion(op));
      return tl::unexpected(reason.empty() ? looked.error() : failure(reason, "undefined-value").value());
    }
    Eigen::VectorXd next = equations.evaluate(op, AccelerationEquations::unknowns);
    bool holds = iteration == 0 && start == Start::reactions_held && equations.hold_reactions(next);
    if (iteration == 0 && start == Start::reactions_held && !holds)
      return failure("no force depends on reactions", "unsolved-equations");
    if (!regular && held++ < held_limit) holds = equations.hold_undefined(next) || holds;
    // Partials without a finite value: the iteration does without them, and names them if it fails.
    if (!holds) undefined = equations.clear_undefined();
    ColumnMatrix matrix = equations.matrix();
    if (!next.allFinite() ||
        !std::all_of(matrix.value.begin(), matrix.value.end(), [](double v) { return std::isfinite(v); })) {
      if (regular && halved++ < halving_limit) {
        step *= 0.5;
        op = regular_point;
        equations.move(op, step.col(0));
        continue;
      }
      const std::string reason = system.undefined_value(system.motion(op));
      return failure(reason.empty() ? "a force or constraint has no finite value" : reason, "undefined-value", history);
    }
    regular = !holds;
    halved = 0;
    step = next;
    const bool one_step = steps == Steps::one_if_linear && !undefined && equations.linear();
    if (!same(matrix, found.factored)) {
      found.linear = found.linear && found.factored.value.empty();
      if (!one_step) found.factored = matrix;
      if (!found.lu.factor(std::move(matrix))) {
        if (undefined) {
          if (const std::string reason = system.undefined_value(system.motion(op)); !reason.empty())
            return failure(reason, "undefined-value");
        }
        if (const std::string reason = system.domain_violation(system.motion(op)); !reason.empty())
          return failure(reason, "undefined-value");
        const std::vector<std::string> free = undetermined(system, augmented, equations.augmented_matrix());
        std::string named = free.empty() ? "" : fmt::format(": nothing fixes {}", fmt::join(free, ", "));
        const auto is_value = [](const std::string& name) { return name.starts_with("the value of "); };
        if (!free.empty() && std::ranges::all_of(free, is_value))
          named += free.size() > 1 ? "; the functions read each other, and contradict each other or agree on any value"
                                   : "; the function reads itself, and no value agrees with it, or any does";
        return failure("the accelerations are not determined" + named, "undetermined-accelerations", free);
      }
    }
    found.lu.solve(step);
    if (one_step) {
      equations.move(op, step.col(0));
      found.op = std::move(op);
      return found;
    }
    if (iteration > 0 && !holds) {
      found.terms = equations.terms(found.factored, op);
      Eigen::VectorXd rounding = rounding_of_solution(found.lu, found.terms), size = equations.values(op).cwiseAbs();
      equations.spread_over_axes(rounding);
      const auto rounding_of_point = [&] {
        return rounding_of_accelerations(system, found.lu, op, [&](const OperatingPoint& at) -> Eigen::VectorXd {
          return equations.evaluate(at, {});
        });
      };
      const bool settled = length.settled(step.col(0), rounding, size, rounding_of_point);
      history.push_back(fmt::format("iteration {}: longest step {:.3e} times its rounding", iteration, length.last()));
      if (settled && !rounding_is_known && iteration + 1 < most) {
        constexpr double margin = 4;  // what lost_digits looks at beside the solution is zero as well
        const auto rows = static_cast<Eigen::Index>(op.lambda.size());
        take_rounding(system, margin * rounding.cwiseMax(rounding_of_point()).segment(augmented.lambda(0), rows), op);
        rounding_is_known = true;
      } else if (settled) {
        equations.move(op, step.col(0));
        found.op = std::move(op);
        found.settled = true;
        found.uncertainty = std::move(rounding);
        return found;
      }
    }
    regular_point = op;
    equations.move(op, step.col(0));
  }
  if (undefined) {
    if (const std::string reason = system.undefined_value(system.motion(op)); !reason.empty()) {
      return failure(reason +
                         "; without it the iteration for accelerations does not settle, and there may be none that "
                         "meet all equations",
                     "undefined-value", history);
    }
  }
  if (stated_limit) history.insert(history.begin(), fmt::format("IC allows {} iterations (AMAXIT)", most));
  equations.evaluate(op, {});
  const std::string name = farthest_equation(system.layout(), equations.equations());
  return failure(
      "the equations for accelerations, reactions and algebraic values did not converge, and there may be "
      "none that meet all equations" +
          (name.empty() ? "" : "; farthest from being met is the equation of " + name),
      "unsolved-equations", history);
}

Result<OperatingPoint> solve(const System& system, OperatingPoint op, Steps steps, Findings& findings) {
  const Layout& layout = system.layout();
  AccelerationEquations equations(system, op);
  if (const auto reason = undefined_row(system, system.motion(op), equations.rows(), 2))
    return failure(*reason, "undefined-value");
  findings.redundant_rows = equations.partition().redundant;
  for (const std::int32_t r : findings.redundant_rows) op.lambda[static_cast<std::size_t>(r)] = 0.0;
  const std::vector<double> first_values = op.algebraic;
  const std::vector<double> first_velocity = op.velocity;
  take_rounding(system, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(op.lambda.size())), op);

  auto solution = iterate(system, equations, op, Start::undefined_held, steps);
  if (!solution) {
    if (auto again = iterate(system, equations, op, Start::reactions_held, steps)) solution = std::move(again);
  }
  if (!solution) return tl::unexpected(solution.error());
  // Where one step and corrections turn out not to be enough.
  const auto go_on = [&, before = solution->settled ? OperatingPoint() : op] {
    return solve(system, before, Steps::until_settled, findings);
  };
  op = std::move(solution->op);
  const SparseLu& lu = solution->lu;
  if (const std::string reason = system.domain_violation(system.motion(op)); !reason.empty())
    return failure(reason, "undefined-value");
  warn_of_changed_starts(layout, first_values, op.algebraic, findings);

  AccelerationCorrections corrections(system, equations, lu, op);
  if (!solution->settled && !corrections.settled()) return go_on();
  corrections.drop_rounding();

  if (equations.massless().any() || !findings.redundant_rows.empty()) equations.evaluate(op, {});
  if (auto accepted = equations.massless().accept(first_velocity, op, equations.equations(), findings); !accepted)
    return tl::unexpected(accepted.error());
  if (!findings.redundant_rows.empty()) {
    // Where the rows agree as they are it does not matter what rounding may make of them.
    auto contradicted = contradicted_accelerations(
        system, equations, op, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(op.acceleration.size())));
    if (!contradicted.empty()) {
      if (!solution->settled) return go_on();
      contradicted =
          contradicted_accelerations(system, equations, op, corrections.rounding().cwiseMax(solution->uncertainty));
    }
    std::vector<std::string> names;
    for (const std::int32_t k : contradicted) names.push_back(system.row_text(k));
    if (!names.empty()) {
      const std::string who = contradiction(system, scaled_gradients(system, equations.rows()),
                                            equations.partition().active, contradicted.front());
      return failure("the constraints contradict each other on accelerations: " + who, "contradicting-constraints",
                     names);
    }
  }
  if (!solution->linear) {
    const LostDigits lost =
        lost_digits(system, equations, lu, solution->factored, op, solution->terms, solution->uncertainty);
    if (lost.part >= loss_of_all) {
      return failure(
          fmt::format("{} stands at a multiple root of its equations, where nothing has a derivative", lost.of),
          "multiple-root");
    }
    if (lost.part >= material_loss) {
      findings.warnings.warning(
          "lost-digits", {},
          fmt::format("the equations have all but a multiple root in {}: rounding leaves its derivatives, and what "
                      "follows from them, known to {:.1e} of themselves",
                      lost.of, lost.part));
    }
  }
  if (!findings.redundant_rows.empty() && !equations.equations().matrix(PartialBy::lambda).value.empty())
    warn_of_undetermined_reactions(system, equations, op, findings.warnings);
  return op;
}

}  // namespace

Result<OperatingPoint> solve_acceleration(const System& system, OperatingPoint op, Findings& findings) {
  return solve(system, std::move(op), Steps::one_if_linear, findings);
}

}  // namespace dynalin

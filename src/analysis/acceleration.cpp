#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/acceleration_checks.h"
#include "analysis/acceleration_corrections.h"
#include "analysis/acceleration_equations.h"
#include "analysis/acceleration_iteration.h"
#include "analysis/contradiction.h"
#include "analysis/initial.h"
#include "analysis/undetermined_reactions.h"
#include "system/undefined_rows.h"

namespace dynalin {

namespace {

// Of a derivative: lost digits worth a warning, and so many that no derivative is left.
constexpr double material_loss = 1e-9, loss_of_all = 0.1;

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

Result<OperatingPoint> solve(const System& system, OperatingPoint op, AccelerationSteps steps, Findings& findings) {
  const Layout& layout = system.layout();
  AccelerationEquations equations(system, op);
  if (const auto reason = undefined_row(system, system.motion(op), equations.rows(), 2))
    return acceleration_failure(*reason, "undefined-value");
  findings.redundant_rows = equations.partition().redundant;
  for (const std::int32_t r : findings.redundant_rows) op.lambda[static_cast<std::size_t>(r)] = 0.0;
  const std::vector<double> first_values = op.algebraic;
  const std::vector<double> first_velocity = op.velocity;
  take_rounding(system, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(op.lambda.size())), op);

  auto solution = iterate_accelerations(system, equations, op, AccelerationStart::undefined_held, steps);
  if (!solution) {
    if (auto again = iterate_accelerations(system, equations, op, AccelerationStart::reactions_held, steps))
      solution = std::move(again);
  }
  if (!solution) return tl::unexpected(solution.error());
  // Where one step and corrections turn out not to be enough.
  const auto go_on = [&, before = solution->settled ? OperatingPoint() : op] {
    return solve(system, before, AccelerationSteps::until_settled, findings);
  };
  op = std::move(solution->op);
  const SparseLu& lu = solution->lu;
  if (const std::string reason = system.domain_violation(system.motion(op)); !reason.empty())
    return acceleration_failure(reason, "undefined-value");
  warn_of_changed_starts(layout, first_values, op.algebraic, findings);

  AccelerationCorrections corrections(system, equations, lu, op);
  if (!corrections.defined()) {
    if (!solution->settled) return go_on();
    return without_finite_value(system, op);
  }
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
      return acceleration_failure("the constraints contradict each other on accelerations: " + who,
                                  "contradicting-constraints", names);
    }
  }
  if (!solution->linear) {
    const LostDigits lost =
        lost_digits(system, equations, lu, solution->factored, op, solution->terms, solution->uncertainty);
    if (lost.part >= loss_of_all) {
      return acceleration_failure(
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
  return solve(system, std::move(op), AccelerationSteps::one_if_linear, findings);
}

}  // namespace dynalin

#include "analysis/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "analysis/settled_reactions.h"
#include "analysis/static_step.h"

namespace dynalin {

namespace {

constexpr double near_rest = 1e-6;  // of the forces at play: Newton's method takes over
// Steps after which the sum of squares must have fallen to the given part, or the search has come to its least.
constexpr int trial_patience = 12;
constexpr double trial_progress = 0.8;
constexpr std::size_t climbing_memory = 3;  // steps that one which may climb must not climb beyond

// ⎡ AᵀA + μ   Bᵀ ⎤ ⎡ y ⎤   ⎡ −Aᵀ U r ⎤      A, B: rows of U J C but for constraints, and those of constraints, with the
// ⎣ B         0  ⎦ ⎣ p ⎦ = ⎣ −U r_c  ⎦      units U, C of equations and unknowns; δ = C y. μ does not hold reactions.
//
// Equations of rest read few unknowns, so AᵀA stays sparse; the coupled form with A itself fills in without bounds, as
// pivots leave its diagonal.
std::optional<Eigen::VectorXd> damped_step(StaticEquations& equations, const Eigen::VectorXd& row_unit,
                                           const Eigen::VectorXd& column_unit, double mu, SparseLu& lu) {
  struct Entry {
    std::int32_t column;
    double value;
  };
  const AugmentedSystem& augmented = equations.augmented();
  const std::int32_t n = augmented.size(), first = augmented.lambda(0), m = augmented.algebraic(0) - first;
  std::vector<std::vector<Entry>> rows(static_cast<std::size_t>(n));
  for_each_entry(equations.tangent(0, 0), [&](std::int32_t r, std::int32_t c, double v) {
    rows[static_cast<std::size_t>(r)].push_back({c, v * row_unit(r) * column_unit(c)});
  });
  std::vector<Triplet> entries;
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(n + m, 1);
  for (std::int32_t r = 0; r < n; ++r) {
    const double off = -row_unit(r) * equations.residual()(r);
    const bool constraint = r >= first && r < first + m;
    const std::int32_t multiplier = n + r - first;
    if (constraint) x(multiplier, 0) = off;
    for (const Entry& a : rows[static_cast<std::size_t>(r)]) {
      if (constraint) {
        entries.push_back({multiplier, a.column, a.value});
        entries.push_back({a.column, multiplier, a.value});
        continue;
      }
      x(a.column, 0) += a.value * off;
      for (const Entry& b : rows[static_cast<std::size_t>(r)]) {
        entries.push_back({a.column, b.column, a.value * b.value});
      }
    }
    entries.push_back({r, r, constraint ? 1e-12 : mu});
  }
  if (!equations.factor(lu, compressed(n + m, n + m, entries))) return std::nullopt;
  lu.solve(x);
  if (!x.allFinite()) return std::nullopt;
  return Eigen::VectorXd(column_unit.cwiseProduct(x.col(0).head(n)));
}

}  // namespace

bool reduce_imbalance(StaticEquations& equations, OperatingPoint& op, int step_limit, StepsMay may) {
  const System& system = equations.system();
  settle(equations, op);
  equations.evaluate(op, Partials::yes);
  const double force = equations.force_scale();
  const Eigen::VectorXd row_unit = equations.row_units(force);
  Eigen::VectorXd column_unit = equations.column_units(op);
  // To keep its value is no equation among others, which a sum of squares would trade for them.
  for (std::size_t z = 0; z < system.layout().states.size(); ++z) {
    if (system.layout().states[z].held_in_statics)
      column_unit(equations.augmented().state(static_cast<std::int32_t>(z))) = 0;
  }
  double merit = equations.merit(force), least = merit, mu = 1e-2, growth = 2;
  double earlier = std::numeric_limits<double>::infinity();
  std::deque<double> last;  // that steps came from, where they may climb
  SparseLu lu;
  for (int k = 0; k < step_limit && std::isfinite(merit) && mu < 1e12; ++k) {
    if (std::sqrt(merit) < near_rest) return true;
    if (k % trial_patience == 0) {
      if (least > trial_progress * earlier) return false;
      earlier = least;
    }
    const auto step = damped_step(equations, row_unit, column_unit, mu, lu);
    bool taken = false;
    if (step) {
      OperatingPoint next = moved(system, op, equations.augmented(), *step, 1.0, {0.5});
      settle(equations, next);
      equations.evaluate(next, Partials::yes);
      const double after = equations.merit(force);
      const double limit = last.empty() ? merit : std::max(merit, *std::ranges::max_element(last));
      if (after < limit * (1 - 1e-6)) {
        if (may == StepsMay::climb) last.push_back(merit);
        if (last.size() > climbing_memory) last.pop_front();
        // Falls as foretold for small steps of a good model: less damping, in proportion to the gain.
        mu *= after < 0.25 * merit ? 0.1 : 0.4;
        growth = 2;
        op = std::move(next);
        system.remember(op);
        merit = after;
        least = std::min(least, merit);
        taken = true;
      }
    }
    if (!taken) {
      mu *= growth;
      growth *= 2;
      equations.evaluate(op, Partials::yes);
    }
  }
  return std::sqrt(merit) < near_rest;
}

}  // namespace dynalin

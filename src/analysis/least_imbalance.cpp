#include "analysis/least_imbalance.h"

#include <algorithm>
#include <cmath>

namespace dynalin {

namespace {

constexpr double near_rest = 1e-6;  // of the forces at play: Newton's method takes over
// Steps after which the sum of squares must have fallen to the given part, or the search has come to its least.
constexpr int patience = 12;
constexpr double progress = 0.8;

// ⎡ E   UJC ⎤ ⎡ p ⎤   ⎡ −U r ⎤      E: 1, and 0 for constraint rows, which makes p their multiplier
// ⎣ (UJC)ᵀ −μ ⎦ ⎣ y ⎦ = ⎣  0   ⎦      U, C: units of equations and unknowns; δ = C y. Reactions are not held by μ.
std::optional<Eigen::VectorXd> damped_step(const StaticEquations& equations, const Eigen::VectorXd& row_unit,
                                           const Eigen::VectorXd& column_unit, double mu) {
  const Saddle& saddle = equations.saddle();
  const std::int32_t n = saddle.size();
  const auto reaction = [&](std::int32_t k) { return k >= saddle.lambda(0) && k < saddle.algebraic(0); };
  std::vector<Triplet> entries;
  for_each_entry(equations.tangent(0, 0), [&](std::int32_t r, std::int32_t c, double v) {
    const double scaled = v * row_unit(r) * column_unit(c);
    entries.push_back({r, n + c, scaled});
    entries.push_back({n + c, r, scaled});
  });
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(2 * n, 1);
  for (std::int32_t k = 0; k < n; ++k) {
    entries.push_back({k, k, reaction(k) ? 0.0 : 1.0});
    entries.push_back({n + k, n + k, reaction(k) ? -1e-12 : -mu});
    x(k, 0) = -row_unit(k) * equations.residual()(k);
  }
  SparseLu lu;
  if (!lu.factor(compressed(2 * n, 2 * n, entries))) return std::nullopt;
  lu.solve(x);
  if (!x.allFinite()) return std::nullopt;
  return Eigen::VectorXd(column_unit.cwiseProduct(x.col(0).tail(n)));
}

}  // namespace

bool reduce_imbalance(StaticEquations& equations, OperatingPoint& op, int step_limit) {
  const System& system = equations.system();
  equations.settle(op);
  equations.evaluate(op, true);
  const double force = equations.force_scale();
  const Eigen::VectorXd row_unit = equations.row_units(force), column_unit = equations.column_units(op);
  double merit = equations.merit(force), mu = 1e-2, growth = 2;
  double earlier = std::numeric_limits<double>::infinity();
  for (int k = 0; k < step_limit && std::isfinite(merit) && mu < 1e12; ++k) {
    if (std::sqrt(merit) < near_rest) return true;
    if (k % patience == 0) {
      if (merit > progress * earlier) return false;
      earlier = merit;
    }
    const auto step = damped_step(equations, row_unit, column_unit, mu);
    bool taken = false;
    if (step) {
      OperatingPoint next = moved(system, op, equations.saddle(), *step, 1.0, 0.5);
      equations.settle(next);
      equations.evaluate(next, true);
      const double after = equations.merit(force);
      if (after < merit * (1 - 1e-6)) {
        // Falls as foretold for small steps of a good model: less damping, in proportion to the gain.
        mu *= after < 0.25 * merit ? 0.1 : 0.4;
        growth = 2;
        op = std::move(next);
        system.remember(op);
        merit = after;
        taken = true;
      }
    }
    if (!taken) {
      mu *= growth;
      growth *= 2;
      equations.evaluate(op, true);
    }
  }
  return std::sqrt(merit) < near_rest;
}

}  // namespace dynalin

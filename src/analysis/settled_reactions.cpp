#include "analysis/settled_reactions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "analysis/initial.h"
#include "system/column_builder.h"

namespace dynalin {

namespace {

bool finite(const std::vector<double>& v) {
  return std::ranges::all_of(v, [](double x) { return std::isfinite(x); });
}

double largest(const std::vector<double>& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::abs(x));
  return most;
}

// The partials of algebraic equations by their own unknowns; those that have no value say that theirs stay.
ColumnMatrix algebraic_block(const ColumnMatrix& whole, std::int32_t first, const std::vector<bool>& undefined) {
  const auto count = static_cast<std::int32_t>(undefined.size());
  const auto is_defined = [&](std::int32_t k) {
    return k >= 0 && k < count && !undefined[static_cast<std::size_t>(k)];
  };
  return compressed_columns(count, count, [&](auto&& take) {
    for (std::int32_t c = 0; c < count; ++c) {
      for_each_in_column(whole, first + c, [&](std::int32_t r, double v) {
        if (is_defined(r - first)) take(r - first, c, v);
      });
      if (!is_defined(c)) take(c, c, 1.0);
    }
  });
}

// Values begin at their IC, at which what reads them need have none, as 1/VARVAL(1) at 0: those that are defined come
// first, by Newton's method, then what reads them.
void define_values(StaticEquations& equations, OperatingPoint& op) {
  constexpr int patience = 8;  // steps without another one that is defined
  const std::int32_t first = equations.augmented().algebraic(0);
  std::vector<bool> undefined(op.algebraic.size(), false);
  auto before = static_cast<std::ptrdiff_t>(undefined.size());
  SparseLu lu;
  for (int fruitless = 0; fruitless < patience; ++fruitless) {
    equations.evaluate(op, Partials::yes);
    Eigen::MatrixXd step = -equations.residual().segment(first, static_cast<Eigen::Index>(undefined.size()));
    for (std::size_t k = 0; k < undefined.size(); ++k) {
      double& missing = step(static_cast<Eigen::Index>(k), 0);
      undefined[k] = !std::isfinite(missing);
      if (undefined[k]) missing = 0;
    }
    const auto left = std::ranges::count(undefined, true);
    if (left == 0) return;
    if (left < before) fruitless = 0;
    before = left;
    ColumnMatrix block = algebraic_block(equations.holding_matrix(), first, undefined);
    if (!finite(block.value) || !equations.factor(lu, std::move(block))) return;
    lu.solve(step);
    if (!step.allFinite()) return;
    for (std::size_t k = 0; k < undefined.size(); ++k) op.algebraic[k] += step(static_cast<Eigen::Index>(k), 0);
  }
}

// Whether functions that have no value here have none at this position: all values that are defined are what their
// functions say, and no step on the way to it.
bool truly_undefined(const StaticEquations& equations) {
  constexpr double met = 16 * std::numeric_limits<double>::epsilon();  // of the terms
  const AugmentedSystem& augmented = equations.augmented();
  for (std::int32_t k = augmented.algebraic(0); k < augmented.state(0); ++k) {
    const double left = equations.residual()(k);
    if (std::isfinite(left) && std::abs(left) > met * equations.magnitude()(k)) return false;
  }
  return true;
}

}  // namespace

void settle(StaticEquations& equations, OperatingPoint& op) {
  const System& system = equations.system();
  const AugmentedSystem& augmented = equations.augmented();
  const std::int32_t coordinates = system.layout().coordinate_count;
  Findings ignored;
  if (auto joined = assemble_position(system, op, ignored)) op = std::move(*joined);
  OperatingPoint next = op;
  Eigen::VectorXd a = Eigen::VectorXd::Zero(coordinates);
  double before = std::numeric_limits<double>::infinity();
  SparseLu lu;
  for (int iteration = 0; iteration < 12; ++iteration) {
    equations.evaluate(next, Partials::yes);
    if (!equations.residual().allFinite()) {
      if (iteration > 0 && truly_undefined(equations)) op = std::move(next);
      return;
    }
    Eigen::MatrixXd step = -equations.residual();
    double level = 0;  // in units of rounding
    for (std::int32_t k = 0; k < coordinates; ++k) step(k, 0) -= equations.holding(k) * a(k);
    step.middleRows(coordinates, augmented.algebraic(0) - coordinates).setZero();
    step.bottomRows(augmented.size() - augmented.state(0)).setZero();
    for (std::int32_t k = 0; k < augmented.size(); ++k) {
      if (step(k, 0) == 0) continue;
      const double off = k < coordinates ? std::abs(equations.holding(k) * a(k)) : 0.0;
      level = std::max(level,
                       std::abs(step(k, 0)) / (equations.rounding()(k) + std::numeric_limits<double>::epsilon() * off +
                                               std::numeric_limits<double>::min()));
    }
    if (level <= 4 || (level <= 1e4 && level >= 0.5 * before)) break;
    before = level;
    if (!equations.factor(lu, equations.holding_matrix())) return;
    lu.solve(step);
    a += step.col(0).head(a.size());
    for (std::size_t k = 0; k < next.lambda.size(); ++k)
      next.lambda[k] += step(augmented.lambda(static_cast<std::int32_t>(k)), 0);
    for (std::size_t k = 0; k < next.algebraic.size(); ++k)
      next.algebraic[k] += step(augmented.algebraic(static_cast<std::int32_t>(k)), 0);
  }
  if (finite(next.lambda) && finite(next.algebraic)) op = std::move(next);
}

void settle_after_motion(StaticEquations& equations, OperatingPoint& op) {
  constexpr double rest = 1e-12;  // rounding of solutions in matrices as they are
  const std::vector<double> reactions = op.lambda, values = op.algebraic;
  define_values(equations, op);
  settle(equations, op);
  bool vanished = false;
  const auto vanish = [&](double& now) {
    vanished = vanished || now != 0;
    now = 0;
  };
  if (largest(op.lambda) <= rest * largest(reactions)) std::ranges::for_each(op.lambda, vanish);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::abs(op.algebraic[k]) <= rest * std::abs(values[k])) vanish(op.algebraic[k]);
  }
  if (vanished) settle(equations, op);
}

}  // namespace dynalin

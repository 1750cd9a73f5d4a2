#include "analysis/original_method.h"

#include <algorithm>
#include <cmath>

#include "analysis/static_step.h"

namespace dynalin {

namespace {

constexpr double small_step = 1e-6;  // of the sizes of unknowns: exact iterations take over
constexpr int more_iterations = 25;  // for that, beyond MAXIT

// Of coordinates, states and values, in lengths of the model, radians and their own sizes.
double relative(const StaticEquations& equations, const OperatingPoint& op, const Eigen::VectorXd& step) {
  const AugmentedSystem& augmented = equations.augmented();
  const Eigen::VectorXd size = equations.column_units(op);
  double largest = 0;
  for (Eigen::Index k = 0; k < step.size(); ++k) {
    if (k < augmented.lambda(0) || k >= augmented.algebraic(0))
      largest = std::max(largest, std::abs(step(k)) / size(k));
  }
  return largest;
}

// Forces and, as their equations have them, values and rates.
double imbalance(const StaticEquations& equations) {
  const Eigen::Index first = equations.augmented().algebraic(0), n = equations.residual().size();
  const double of_values = n > first ? equations.residual().tail(n - first).cwiseAbs().maxCoeff() : 0.0;
  return std::max(equations.imbalance(), of_values);
}

}  // namespace

bool iterate_by_newton(StaticEquations& equations, OperatingPoint& op, const OriginalMethod& options,
                       StaticHistory& history) {
  equations.measure_by(Yardstick::model);
  equations.look_at_motion();
  SparseLu lu;
  bool met = false;
  int left = options.iteration_limit;
  for (int k = 0; left > 0; ++k, --left) {
    const std::size_t entries = options.pattern.size();
    const bool anew = k == 0 || met || entries == 0 || options.pattern[static_cast<std::size_t>(k) % entries];
    equations.evaluate(op, anew ? Partials::yes : Partials::no);
    if (!equations.residual().allFinite()) return false;
    const double s = options.stability;
    if (anew && !equations.factor(lu, equations.tangent_of_motion(s, s, s))) return false;
    Eigen::MatrixXd step = -equations.residual();
    lu.solve(step);
    if (!step.allFinite()) return false;
    const double largest = relative(equations, op, step.col(0));
    history.add(imbalance(equations), equations.rate_of_states());
    if (!met && largest <= options.tolerance.error && imbalance(equations) <= options.tolerance.imbalance) {
      met = true;
      left = more_iterations;
    }
    if (met && largest <= small_step) return true;
    op = moved(equations.system(), op, equations.augmented(), step.col(0), 1.0, options.limits);
    equations.system().remember(op);
  }
  return met;
}

}  // namespace dynalin

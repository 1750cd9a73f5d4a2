#include "analysis/rest_beside.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/comparable_scales.h"
#include "analysis/settled_reactions.h"
#include "analysis/static_equations.h"
#include "analysis/static_step.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;

constexpr int most_steps = 30;
constexpr double too_dependent = 1e-9;    // of motions of unit size
constexpr double free_state_hold = 1e-3;  // in comparable units: each step leaves as much of what it should take away
constexpr double settled = 1e-9;  // of the size of an unknown: steps that become no smaller are rounding from here on

// ⎡ J   B ⎤ ⎡ δ ⎤   ⎡ −r ⎤     B, the basis in units of coordinates: δ has no share of what is kept, and forces p along
// ⎣ Bᵀ  0 ⎦ ⎣ p ⎦ = ⎣  0 ⎦     it may remain. Regular where J alone is singular along these motions.
std::optional<Eigen::VectorXd> step_across(StaticEquations& equations, const Matrix& B, double hold_states) {
  const ColumnMatrix J = equations.tangent(0, hold_states);
  std::vector<Triplet> entries;
  for_each_entry(J, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
  const auto kept = static_cast<std::int32_t>(B.cols());
  for (std::int32_t k = 0; k < kept; ++k) {
    for (std::int32_t c = 0; c < B.rows(); ++c) {
      if (B(c, k) == 0) continue;
      entries.push_back({c, J.columns + k, B(c, k)});
      entries.push_back({J.rows + k, c, B(c, k)});
    }
  }
  const ColumnMatrix bordered = compressed(J.rows + kept, J.columns + kept, entries);
  const ComparableScales scales(bordered);
  SparseLu lu;
  if (!equations.factor(lu, scales.of(bordered))) return std::nullopt;
  Matrix x = Matrix::Zero(bordered.rows, 1);
  x.topRows(J.rows) = -equations.residual();
  x = scales.row.asDiagonal() * x;
  lu.solve(x);
  x = scales.column.asDiagonal() * x;
  if (!x.allFinite()) return std::nullopt;
  return Eigen::VectorXd(x.topRows(J.rows));
}

}  // namespace

Matrix basis_of_motions(const Matrix& motions, const Eigen::VectorXd& size, double dependent) {
  if (motions.size() == 0) return Matrix(motions.rows(), 0);
  Matrix unit = size.cwiseInverse().asDiagonal() * motions;
  for (Eigen::Index k = 0; k < unit.cols(); ++k) {
    if (const double norm = unit.col(k).norm(); norm > 0) unit.col(k) /= norm;
  }
  Eigen::ColPivHouseholderQR<Matrix> qr(unit);
  qr.setThreshold(dependent);
  return size.asDiagonal() * (qr.householderQ() * Matrix::Identity(unit.rows(), qr.rank()));
}

std::optional<OperatingPoint> rest_beside(const System& system, OperatingPoint op, const Matrix& kept) {
  StaticEquations equations(system);
  const AugmentedSystem& augmented = equations.augmented();
  const std::int32_t n = system.layout().coordinate_count;
  Eigen::VectorXd size(n);
  for (std::int32_t k = 0; k < n; ++k) size(k) = system.coordinate_scale(k);
  const Matrix B = size.cwiseAbs2().cwiseInverse().asDiagonal() * basis_of_motions(kept, size, too_dependent);
  double hold_states = 0, before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most_steps; ++k) {
    settle(equations, op);
    equations.evaluate(op, Partials::yes);
    if (!equations.residual().allFinite()) return std::nullopt;
    auto step = step_across(equations, B, hold_states);
    if (!step && hold_states == 0) {  // pure integrators have any value
      hold_states = free_state_hold;
      step = step_across(equations, B, hold_states);
    }
    if (!step) return std::nullopt;
    double largest = step->head(n).cwiseQuotient(size).lpNorm<Eigen::Infinity>();
    for (std::size_t z = 0; z < op.state.size(); ++z) {
      const double change = std::abs((*step)(augmented.state(static_cast<std::int32_t>(z))));
      largest = std::max(largest, change / std::max(1.0, std::abs(op.state[z])));
    }
    if (largest == 0 || (largest <= settled && largest > 0.5 * before)) return op;
    before = largest;
    op = moved(system, op, augmented, *step, 1.0, {1.0});
  }
  return std::nullopt;
}

}  // namespace dynalin

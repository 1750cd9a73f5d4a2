#include "analysis/acceleration_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "analysis/acceleration_rounding.h"

namespace dynalin {

namespace {

// Redundant rows are combinations of the others to 1e-9 of themselves, and so is what follows for their rates.
constexpr double contradicting_acceleration = 1e-8;

// The largest of the three components of a vector of a body that a coordinate belongs to, or its own size.
double along_axes(const Layout& layout, const std::vector<double>& values, std::int32_t coordinate) {
  const auto at = static_cast<std::size_t>(coordinate);
  if (coordinate >= layout.body_coordinate_count) return std::abs(values[at]);
  const std::size_t first = at - at % 3;
  return std::max({std::abs(values[first]), std::abs(values[first + 1]), std::abs(values[first + 2])});
}

// Coordinates whose acceleration moves mass. That of others only follows: at rest from velocities squared, of which
// nothing is left but rounding, and what reads it is looked at itself.
std::vector<bool> with_inertia(const AccelerationEquations& equations) {
  const std::int32_t coordinates = equations.augmented().lambda(0);
  std::vector<bool> inertia(static_cast<std::size_t>(coordinates), false);
  for_each_entry(equations.equations().matrix(PartialBy::acceleration), [&](std::int32_t r, std::int32_t c, double v) {
    if (r < coordinates && v != 0) inertia[static_cast<std::size_t>(c)] = true;
  });
  return inertia;
}

std::string unknown_text(const System& system, const AccelerationEquations& equations, std::int32_t k) {
  const Layout& layout = system.layout();
  const AugmentedSystem& augmented = equations.augmented();
  if (k >= augmented.size()) return "the balance of freedoms without mass";
  if (k < augmented.lambda(0)) return "the acceleration " + layout.coordinate_text(k);
  if (k < augmented.algebraic(0)) return "the reaction " + system.row_text(k - augmented.lambda(0));
  if (k < augmented.state(0)) {
    return "the value of " + layout.algebraic[static_cast<std::size_t>(k - augmented.algebraic(0))].owner->full_text();
  }
  return "the rate of " + layout.states[static_cast<std::size_t>(k - augmented.state(0))].owner->full_text();
}

// How near a change of the matrix J brings it to a singular one: the largest eigenvalue of J⁻¹ ΔJ, one where it is. A
// function that bends in what does not depend on it brings nothing nearer, however steep it becomes. `x`, of which this
// is sought, ends as the vector that belongs to it, or zero.
double part_of_singular(const SparseLu& lu, const ColumnMatrix& change, Eigen::MatrixXd& x) {
  constexpr int settling = 4, measured = 4;
  const auto count = static_cast<std::size_t>(x.size());
  double growth = 1;
  for (int k = 0; k < settling + measured; ++k) {
    const double before = x.lpNorm<Eigen::Infinity>();
    if (!(before > 0)) return 0;
    x /= before;
    Eigen::MatrixXd off = Eigen::MatrixXd::Zero(x.rows(), 1);
    change.multiply_add({x.data(), count}, {off.data(), count});
    lu.solve(off);
    if (!off.allFinite()) return std::numeric_limits<double>::infinity();
    x = std::move(off);
    if (k >= settling) growth *= x.lpNorm<Eigen::Infinity>();
  }
  return std::pow(growth, 1.0 / measured);
}

}  // namespace

std::vector<std::int32_t> contradicted_accelerations(const System& system, const AccelerationEquations& equations,
                                                     const OperatingPoint& op, const Eigen::VectorXd& rounding) {
  const ConstraintRows& rows = equations.rows();
  const double tolerance = std::max(contradicting_acceleration,
                                    op.initial_conditions.acceleration_error.value_or(100 * op.redundancy_tolerance));
  std::vector<std::int32_t> contradicted;
  for (const std::int32_t k : equations.partition().redundant) {
    const bool position = rows.level(k) == RowLevel::position;
    const double left = position ? rows.along_motion(k).acceleration : rows.along_motion(k).rate;
    // The terms g q″ and those of velocities; what remains without q″ is a term too.
    double size = 0, noise = 0, follows = 0;
    for (const auto& e : rows.row(k)) {
      const auto at = static_cast<std::size_t>(e.column);
      size += std::abs(e.c.g) * along_axes(system.layout(), op.acceleration, e.column) +
              std::abs(e.c.a1) * along_axes(system.layout(), op.velocity, e.column);
      noise += std::abs(e.c.g) * rounding(e.column);
      follows += e.c.g * op.acceleration[at];
    }
    size += std::abs(left - follows);
    if (std::abs(left) > tolerance * size + 4 * noise) contradicted.push_back(k);
  }
  return contradicted;
}

LostDigits lost_digits(const System& system, AccelerationEquations& equations, const SparseLu& lu,
                       const ColumnMatrix& factored, const OperatingPoint& op, const Eigen::VectorXd& terms,
                       const Eigen::VectorXd& uncertainty) {
  const AugmentedSystem& augmented = equations.augmented();
  const Eigen::Index count = terms.size();
  const auto n = static_cast<std::size_t>(count);
  std::minstd_rand random(1);
  const auto sign = [&] { return random() % 2 == 0 ? 1.0 : -1.0; };
  Eigen::MatrixXd answer(count, 1);
  Eigen::VectorXd shift = uncertainty;
  for (Eigen::Index k = 0; k < terms.size(); ++k) answer(k, 0) = sign() * terms(k), shift(k) *= sign();
  lu.solve(answer);
  Eigen::VectorXd change = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::infinity());
  Eigen::VectorXd bend = Eigen::VectorXd::Zero(count);
  double nearer = std::numeric_limits<double>::infinity();
  std::vector<bool> bends(n, false);  // an equation, and the unknown that is its own
  // Both ways: an expression that switches at the point itself does not bend.
  for (const double way : {1.0, -1.0}) {
    OperatingPoint there = op;
    equations.move(there, way * shift);
    if (!equations.look_at_massless(there)) continue;
    const Eigen::VectorXd missing = equations.evaluate(there, AccelerationEquations::unknowns);
    if (missing.size() != count) return {};
    bend = bend.cwiseMax(missing.cwiseAbs());
    ColumnMatrix difference = equations.matrix();
    if (difference.value.size() != factored.value.size()) return {};
    for (std::size_t k = 0; k < factored.value.size(); ++k) difference.value[k] -= factored.value[k];
    Eigen::MatrixXd off = Eigen::MatrixXd::Zero(count, 1);
    difference.multiply_add({answer.data(), n}, {off.data(), n});
    if (!off.allFinite()) continue;
    lu.solve(off);
    change = change.cwiseMin(off.col(0).cwiseAbs());
    nearer = std::min(nearer, part_of_singular(lu, difference, off));
    Eigen::MatrixXd bent = Eigen::MatrixXd::Zero(count, 1);
    difference.multiply_add({off.data(), n}, {bent.data(), n});
    for (Eigen::Index k = 0; k < bent.rows(); ++k) bends[static_cast<std::size_t>(k)] = bent(k, 0) != 0;
  }
  Eigen::VectorXd size = answer.col(0).cwiseAbs();
  equations.spread_over_axes(size);
  Eigen::VectorXd rounding = rounding_of_solution(lu, terms);
  equations.spread_over_axes(rounding);
  const Eigen::VectorXd value = equations.values(op).cwiseAbs();
  const std::vector<bool> inertia = with_inertia(equations);
  std::vector<double> parts(n, 0.0);
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(count); ++k) {
    // An answer that is nothing but rounding is zero, and so has no digits to lose; nor has an acceleration that is
    // nothing but what cancels in its terms.
    if (size(k) <= 1e3 * rounding(k) || (k < augmented.lambda(0) && value(k) <= 1e3 * rounding(k))) continue;
    if (k < augmented.lambda(0) && !inertia[static_cast<std::size_t>(k)]) continue;
    // Nor has an algebraic value that is nothing but rounding a derivative to lose.
    const bool algebraic = k >= augmented.algebraic(0) && k < augmented.state(0);
    if (!(size(k) > 0) || !std::isfinite(change(k)) || (algebraic && value(k) <= 1e3 * bend(k))) continue;
    parts[static_cast<std::size_t>(k)] = change(k) / size(k);
  }
  // What loses most, where that is the doing of a root that is all but multiple, and is named after an equation that
  // bends rather than after one that follows it.
  LostDigits lost{parts.empty() ? 0.0 : std::min(nearer, *std::max_element(parts.begin(), parts.end())), {}};
  for (const bool own : {false, true}) {
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(count); ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (parts[at] < 0.5 * lost.part || (own && !bends[at])) continue;
      lost.of = unknown_text(system, equations, k);
      break;
    }
  }
  return lost;
}

}  // namespace dynalin

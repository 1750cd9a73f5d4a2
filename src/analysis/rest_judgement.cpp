#include "analysis/rest_judgement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "analysis/balance.h"
#include "analysis/comparable_scales.h"
#include "analysis/values_in_order.h"

namespace dynalin {

namespace {

constexpr double roundings = 100;              // that residuals may be off: the estimate counts each number once
constexpr double explained = 30;               // times the largest step that rounding was seen to make
constexpr double softest = 1e13;               // answer of an unknown that more than rounding of the tangent holds
constexpr double softest_with_identity = 1e9;  // the same where a little of the identity holds what nothing else does
constexpr double indifference = 1e-6;          // a step that rounding makes, of the size of an unknown

bool row_counts(const StaticEquations& equations, Eigen::Index k) {
  const AugmentedSystem& augmented = equations.augmented();
  return k < augmented.lambda(0) || k >= augmented.algebraic(0);  // constraints are met by assembly
}

class ScaledTangent {
 public:
  explicit ScaledTangent(const ColumnMatrix& J) : scales_(J), matrix_(scales_.of(J)) {}

  // With a little of the identity only where it is singular.
  bool factor(StaticEquations& equations) {
    regular_ = factor(equations, 0);
    return regular_ || factor(equations, 1e-12);
  }
  // Where a direction is indifferent, with a little of the identity.
  bool factor(StaticEquations& equations, double identity) {
    if (identity == 0) return equations.factor(lu_, matrix_);
    std::vector<Triplet> entries;
    entries.reserve(matrix_.value.size() + static_cast<std::size_t>(matrix_.rows));
    for_each_entry(matrix_, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
    for (std::int32_t k = 0; k < matrix_.rows; ++k) {
      if (row_counts(equations, k)) entries.push_back({k, k, identity});
    }
    return equations.factor(lu_, compressed(matrix_.rows, matrix_.columns, entries));
  }
  void solve(Eigen::MatrixXd& x) const {
    x = scales_.row.asDiagonal() * x;
    lu_.solve(x);
    x = scales_.column.asDiagonal() * x;
  }
  // Whether unknowns answer to a change of all equations by about their largest coefficient as nothing does that is
  // held by more than rounding of the matrix.
  std::vector<bool> held_by_nothing() const {
    Eigen::MatrixXd x = random_signs(Eigen::VectorXd::Ones(matrix_.rows), 2);
    lu_.solve(x);
    std::vector<bool> nothing;
    for (Eigen::Index k = 0; k < x.rows(); ++k)
      nothing.push_back(!(x.row(k).cwiseAbs().maxCoeff() < (regular_ ? softest : softest_with_identity)));
    return nothing;
  }

 private:
  bool regular_ = false;
  ComparableScales scales_;
  ColumnMatrix matrix_;
  SparseLu lu_;
};

// A value of an expression has the size that it takes where what it depends on changes by its own; one that reads
// others follows them, and those that read each other in a circle begin somewhere.
void add_sizes_of_values(const AugmentedSystem& augmented, const ColumnMatrix& tangent, Eigen::VectorXd& size) {
  const std::int32_t first = augmented.algebraic(0), end = augmented.state(0);
  const auto is_value = [&](std::int32_t k) { return k >= first && k < end; };
  ValuesInOrder values(end - first);
  const Eigen::VectorXd own = size;
  for_each_entry(tangent, [&](std::int32_t r, std::int32_t c, double v) {
    if (!is_value(r) || r == c || v == 0 || (c >= augmented.lambda(0) && c < first)) return;
    if (is_value(c)) {
      values.reads(r - first, c - first, v);
    } else {
      size(r) = std::max(size(r), std::abs(v) * own(c));
    }
  });
  values.for_each_reading([&](std::int32_t reader, std::int32_t read, double slope) {
    size(first + reader) = std::max(size(first + reader), std::abs(slope) * size(first + read));
  });
}

// Lengths, radians, states by their value, at least one.
Eigen::VectorXd unknown_sizes(const StaticEquations& equations, const OperatingPoint& op, const ColumnMatrix& tangent) {
  const System& system = equations.system();
  const AugmentedSystem& augmented = equations.augmented();
  Eigen::VectorXd size = Eigen::VectorXd::Ones(augmented.size());
  for (std::int32_t k = 0; k < augmented.lambda(0); ++k) size(k) = system.coordinate_scale(k);
  for (std::size_t k = 0; k < op.state.size(); ++k)
    size(augmented.state(static_cast<std::int32_t>(k))) = std::max(1.0, std::abs(op.state[k]));
  for (std::size_t k = 0; k < op.algebraic.size(); ++k)
    size(augmented.algebraic(static_cast<std::int32_t>(k))) = std::abs(op.algebraic[k]);
  add_sizes_of_values(augmented, tangent, size);
  for (Eigen::Index k = 0; k < size.size(); ++k) {
    if (!(size(k) > 0)) size(k) = 1;
  }
  return size;
}

// Nodes of a body that deforms share its elements: their rounding is not told apart from that of places.
Eigen::VectorXd rounding_of_deformation(const StaticEquations& equations) {
  const Layout& layout = equations.system().layout();
  Eigen::VectorXd size = equations.rounding_of_terms();
  const auto take = [&](std::int32_t first, std::int32_t count) {
    size.segment(first, count) = equations.rounding().segment(first, count);
  };
  for (const TurningWhole& whole : layout.turning_wholes) {
    for (const BodyId b : whole.bodies) {
      const BodyBlock& block = layout.bodies[static_cast<std::size_t>(b.index)];
      take(block.offset, block.count);
    }
  }
  for (const ExtraBlock& e : layout.extras) {
    if (e.kind.role == ExtraRole::nodal) take(e.offset, e.count);
  }
  return size;
}

}  // namespace

Eigen::MatrixXd random_signs(const Eigen::VectorXd& size, Eigen::Index columns) {
  Eigen::MatrixXd x(size.size(), columns);
  std::uint64_t bits = 0x9e3779b97f4a7c15u;
  for (Eigen::Index c = 0; c < columns; ++c) {
    for (Eigen::Index r = 0; r < size.size(); ++r) {
      bits = bits * 6364136223846793005u + 1442695040888963407u;
      x(r, c) = (bits >> 63) != 0 ? size(r) : -size(r);
    }
  }
  return x;
}

bool balanced_to_rounding(const StaticEquations& equations) {
  if (!equations.residual().allFinite()) return false;
  for (Eigen::Index k = 0; k < equations.residual().size(); ++k) {
    if (!row_counts(equations, k)) continue;
    if (std::abs(equations.residual()(k)) > roundings * equations.rounding()(k)) return false;
  }
  return true;
}

std::vector<bool> free_unknowns(StaticEquations& equations, const OperatingPoint& op) {
  equations.evaluate(op, Partials::yes);
  const auto count = static_cast<std::size_t>(equations.residual().size());
  const auto judgement = judge(equations, op);
  if (!judgement) return std::vector<bool>(count, true);
  std::vector<bool> free = judgement->indifferent;
  // Along axes that turn with each part, r′ = r − δθ × r: a vehicle that turns as a whole changes nothing there.
  const ColumnMatrix J = equations.tangent(0, 0);
  std::vector<Triplet> entries;
  for_each_entry(J, [&](std::int32_t r, std::int32_t c, double v) { entries.push_back({r, c, v}); });
  const Layout& layout = equations.system().layout();
  for (const BodyBlock& b : layout.bodies) {
    if (!b.turns()) continue;
    for (std::int32_t first = b.offset; first < b.offset + 6; first += 3) {
      const Eigen::Vector3d r = equations.residual().segment<3>(first);
      for (std::int32_t axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d turned = Eigen::Vector3d::Unit(axis).cross(r);
        for (std::int32_t k = 0; k < 3; ++k) entries.push_back({first + k, b.offset + 3 + axis, -turned(k)});
      }
    }
  }
  ScaledTangent tangent(compressed(J.rows, J.columns, entries));
  if (tangent.factor(equations)) {
    const std::vector<bool> nothing = tangent.held_by_nothing();
    for (std::size_t k = 0; k < nothing.size(); ++k) {
      if (nothing[k] && row_counts(equations, static_cast<Eigen::Index>(k))) free[k] = true;
    }
  }
  // What is free may point elsewhere when its part has turned.
  for (const BodyBlock& b : layout.bodies) {
    for (std::int32_t first = b.offset; first < b.offset + b.count; first += 3) {
      const auto from = free.begin() + first;
      if (std::find(from, from + 3, true) != from + 3) std::fill(from, from + 3, true);
    }
  }
  return free;
}

Eigen::VectorXd undetermined_part(StaticEquations& equations, Eigen::VectorXd move) {
  constexpr double identity = 1e-10;  // far above rounding, far below what holds anything
  const AugmentedSystem& augmented = equations.augmented();
  move.segment(augmented.lambda(0), augmented.state(0) - augmented.lambda(0)).setZero();
  const ColumnMatrix J = equations.tangent(0, 0);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(move.size(), 1);
  for_each_entry(J, [&](std::int32_t r, std::int32_t c, double v) { x(r, 0) += v * move(c); });
  ScaledTangent tangent(J);
  if (!tangent.factor(equations, identity)) return move;
  tangent.solve(x);
  return x.allFinite() ? Eigen::VectorXd(move - x.col(0)) : move;
}

std::optional<RestJudgement> judge(StaticEquations& equations, const OperatingPoint& op) {
  const Eigen::VectorXd& residual = equations.residual();
  const Eigen::VectorXd& rounding = equations.rounding();
  if (!residual.allFinite() || !rounding.allFinite()) return std::nullopt;
  RestJudgement j;
  j.balanced = true;
  for (Eigen::Index k = 0; k < residual.size() && j.balanced; ++k) {
    if (!row_counts(equations, k)) continue;
    const double r = std::abs(residual(k));
    j.balanced = r <= force_balance * equations.magnitude()(k) || r <= roundings * rounding(k);
  }
  const ColumnMatrix J = equations.tangent(0, 0);
  j.size = unknown_sizes(equations, op, J);
  j.indifferent.assign(static_cast<std::size_t>(residual.size()), false);
  j.determined = j.excused = true;
  if (residual.size() == 0) return j;

  ScaledTangent tangent(J);
  if (!tangent.factor(equations)) return std::nullopt;
  // What rounding does to the step: the largest of several steps with random signs of what rounding adds to residuals.
  constexpr Eigen::Index samples = 5;
  Eigen::MatrixXd x(residual.size(), 1 + 2 * samples);
  x << -residual, random_signs(equations.rounding_of_terms(), samples),
      random_signs(rounding_of_deformation(equations), samples);
  tangent.solve(x);
  if (!x.allFinite()) return std::nullopt;
  j.step = j.newton = x.col(0);
  const std::vector<bool> nothing = tangent.held_by_nothing();
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    if (!row_counts(equations, k)) continue;
    const auto largest = [&](Eigen::Index first) { return x.row(k).segment(first, samples).cwiseAbs().maxCoeff(); };
    const double by_rounding = largest(1) + equations.rounding_of_unknowns()(k);
    const double relative = std::abs(j.newton(k)) / j.size(k);
    const bool noise = std::abs(j.newton(k)) <= explained * by_rounding;
    const auto i = static_cast<std::size_t>(k);
    j.indifferent[i] = by_rounding > indifference * j.size(k) || nothing[i];
    if (noise && by_rounding > rest_step * j.size(k)) j.step(k) = 0;
    j.excused =
        j.excused && (noise || relative <= rest_step || std::abs(j.newton(k)) <= explained * largest(1 + samples));
    j.largest_of_all = std::max(j.largest_of_all, relative);
    if (noise) continue;
    j.determined = j.determined && relative <= rest_step;
    if (relative > j.largest) j.largest = relative, j.largest_at = k;
  }
  return j;
}

}  // namespace dynalin

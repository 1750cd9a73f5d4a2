#include "analysis/pushed_away.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "system/sparse_lu.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;

constexpr std::int32_t most_coordinates = 400;  // coordinates: the matrices are full
constexpr double unseen_stiffness = 1e-10;      // of the largest stiffness: rounding of the others
constexpr double most_without_energy = 0.05;    // of a negative stiffness, what is not symmetric along it
constexpr double least_push = 1e3;              // in units of rounding
constexpr double share_of_size = 0.01;

// K of the motions that the constraints allow, by a basis of them; both in units of coordinates.
struct Allowed {
  Matrix basis, stiffness;
};

// The tangent by blocks, coordinates in units of their sizes. There may be any number of values and states, the others:
// what is of them are entries.
struct Blocks {
  Matrix K;     // coordinates by coordinates,
  Matrix onto;  // by multipliers,
  Matrix G;     // constraint rows by coordinates
  std::vector<Triplet> by_others, others, others_by_coordinates;
};

Blocks blocks(const StaticEquations& equations, const Eigen::VectorXd& size) {
  const std::int32_t n = static_cast<std::int32_t>(size.size()), first = equations.augmented().algebraic(0);
  Blocks b{Matrix::Zero(n, n), Matrix::Zero(n, first - n), Matrix::Zero(first - n, n), {}, {}, {}};
  for_each_entry(equations.tangent(0, 0), [&](std::int32_t r, std::int32_t c, double v) {
    if (r < n) v *= size(r);
    if (c < n) v *= size(c);
    if (r < n) {
      if (c < n)
        b.K(r, c) += v;
      else if (c < first)
        b.onto(r, c - n) += v;
      else
        b.by_others.push_back({r, c - first, v});
    } else if (r < first) {
      if (c < n) b.G(r - n, c) += v;
    } else if (c < n) {
      b.others_by_coordinates.push_back({r - first, c, v});
    } else if (c >= first) {
      b.others.push_back({r - first, c - first, v});
    }
  });
  return b;
}

// K where values and states follow; false if nothing determines them.
bool let_others_follow(Blocks& b, std::int32_t count) {
  constexpr Index at_once = 64;  // columns
  SparseLu lu;
  if (!lu.factor(compressed(count, count, b.others))) return false;
  for (Index begin = 0; begin < b.K.cols(); begin += at_once) {
    Matrix follow = Matrix::Zero(count, std::min(at_once, b.K.cols() - begin));
    for (const Triplet& t : b.others_by_coordinates) {
      if (t.column >= begin && t.column < begin + follow.cols()) follow(t.row, t.column - begin) += t.value;
    }
    lu.solve(follow);
    for (const Triplet& t : b.by_others)
      b.K.middleCols(begin, follow.cols()).row(t.row) -= t.value * follow.row(t.column);
  }
  return true;
}

std::optional<Allowed> allowed_motions(const StaticEquations& equations, const Eigen::VectorXd& size) {
  const AugmentedSystem& augmented = equations.augmented();
  const Index n = size.size(), rows = augmented.algebraic(0) - n;
  Blocks tangent = blocks(equations, size);
  if (const std::int32_t others = augmented.size() - augmented.algebraic(0); others > 0) {
    if (!let_others_follow(tangent, others)) return std::nullopt;
  }
  const Matrix &K = tangent.K, &G = tangent.G, &onto = tangent.onto;
  // Friction: forces that depend on reactions.
  for (Index k = 0; k < rows; ++k) {
    const double norm = G.row(k).norm();
    if (norm > 0 && !((onto.col(k) + G.row(k).transpose()).norm() <= unseen_stiffness * norm)) return std::nullopt;
  }
  Matrix basis = Matrix::Identity(n, n);
  if (rows > 0) {
    Matrix of_unit_size = G;
    for (Index k = 0; k < rows; ++k) {
      if (const double norm = G.row(k).norm(); norm > 0) of_unit_size.row(k) /= norm;
    }
    const Eigen::ColPivHouseholderQR<Matrix> qr(of_unit_size.transpose());
    const Matrix Q = qr.householderQ();
    basis = Q.rightCols(n - qr.rank());
  }
  if (basis.cols() == 0 || !K.allFinite()) return std::nullopt;
  return Allowed{basis, basis.transpose() * K * basis};
}

}  // namespace

std::optional<Eigen::VectorXd> step_off_saddle(StaticEquations& equations, const OperatingPoint& at_rest,
                                               const OperatingPoint& drawn) {
  const System& system = equations.system();
  const std::int32_t n = system.layout().coordinate_count;
  if (n == 0 || n > most_coordinates) return std::nullopt;
  Eigen::VectorXd size(n);
  for (std::int32_t k = 0; k < n; ++k) size(k) = system.coordinate_scale(k);
  equations.evaluate(at_rest, Partials::yes);
  const auto allowed = allowed_motions(equations, size);
  if (!allowed) return std::nullopt;
  const Matrix symmetric = 0.5 * (allowed->stiffness + allowed->stiffness.transpose()),
               without_energy = allowed->stiffness - symmetric;
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd& stiffness = solver.eigenvalues();
  const double least = -unseen_stiffness * stiffness.cwiseAbs().maxCoeff();
  if (!(stiffness(0) < least)) return std::nullopt;

  equations.evaluate(drawn, Partials::yes);
  const Eigen::VectorXd push = -equations.residual().head(n), rounding = equations.rounding().head(n);
  Eigen::VectorXd off = Eigen::VectorXd::Zero(n);
  for (Index k = 0; k < stiffness.size() && stiffness(k) < least; ++k) {
    const Eigen::VectorXd direction = solver.eigenvectors().col(k);
    if (!((without_energy * direction).norm() <= most_without_energy * -stiffness(k))) return std::nullopt;
    const Eigen::VectorXd motion = size.cwiseProduct(allowed->basis * direction);
    const double work = push.dot(motion);
    if (std::abs(work) > least_push * rounding.dot(motion.cwiseAbs())) off += work * motion;
  }
  const double largest = off.cwiseQuotient(size).cwiseAbs().maxCoeff();
  if (!(largest > 0) || !std::isfinite(largest)) return std::nullopt;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(equations.augmented().size());
  step.head(n) = share_of_size / largest * off;
  return step;
}

}  // namespace dynalin

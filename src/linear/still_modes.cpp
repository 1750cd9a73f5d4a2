#include "linear/still_modes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linear/mass_root.h"
#include "linear/perturbation.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;

// Residuals of a mode that belongs to a system are far below this, those of one that is driven from outside above.
constexpr double residual_tolerance = 1e-11;
// Motions of a still mode are roundings beside its own states.
constexpr double largest_motion = 1e-8;

// States whose columns of T move something that has mass.
std::vector<bool> moving_mass(const MassRoot& root, const LinearSystem& linear) {
  const auto n = static_cast<Index>(linear.model.states.size());
  std::vector<bool> moves(static_cast<std::size_t>(n), false);
  if (root.bodies() == 0 || linear.equations->coordinates() == 0) return moves;
  constexpr Index at_a_time = 64;
  for (Index first = 0; first < n; first += at_a_time) {
    const Index count = std::min(at_a_time, n - first);
    Eigen::MatrixXcd units = Eigen::MatrixXcd::Zero(n, count);
    units.middleRows(first, count).setIdentity();
    const Matrix motions = linear.equations->motions(units).real();
    for (const Matrix& columns :
         {Matrix(motions.topRows(motions.rows() / 2)), Matrix(motions.bottomRows(motions.rows() / 2))}) {
      const Eigen::RowVectorXd weighed = root.of(columns).cwiseAbs().colwise().maxCoeff(), size = root.size_of(columns);
      for (Index k = 0; k < count; ++k) {
        if (weighed(k) > 1e-12 * size(k)) moves[static_cast<std::size_t>(first + k)] = true;
      }
    }
  }
  return moves;
}

// States that nothing on the way to those marked can see.
std::vector<Index> without_influence(const Matrix& A, const std::vector<bool>& marked) {
  std::vector<bool> seen = marked;
  std::vector<Index> open, others;
  for (Index k = 0; k < A.rows(); ++k) {
    if (seen[static_cast<std::size_t>(k)]) open.push_back(k);
  }
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    for (Index j = 0; j < A.cols(); ++j) {
      if (A(i, j) == 0.0 || seen[static_cast<std::size_t>(j)]) continue;
      seen[static_cast<std::size_t>(j)] = true;
      open.push_back(j);
    }
  }
  for (Index k = 0; k < A.rows(); ++k) {
    if (!seen[static_cast<std::size_t>(k)]) others.push_back(k);
  }
  return others;
}

// Units of the states of a system in which its rows and columns are about equally large (Osborne).
Eigen::VectorXd balancing(const Matrix& A) {
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(A.rows());
  for (int sweep = 0; sweep < 10; ++sweep) {
    for (Index k = 0; k < A.rows(); ++k) {
      double row = 0, column = 0;
      for (Index j = 0; j < A.rows(); ++j) {
        if (j == k) continue;
        row += std::abs(A(k, j)) * unit(j), column += std::abs(A(j, k)) / unit(j);
      }
      if (row > 0 && column > 0) unit(k) = std::exp2(std::round(0.5 * std::log2(row / column)));
    }
  }
  return unit;
}

}  // namespace

void clear_still_modes(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                       EigenSolution& solution) {
  if (solution.vectors.cols() == 0) return;
  const Matrix& A = linear.model.A;
  const std::vector<Index> inner = without_influence(A, moving_mass(MassRoot(system, op), linear));
  if (inner.empty() || static_cast<Index>(inner.size()) == A.rows()) return;
  std::vector<Index> outer;
  for (Index k = 0; k < A.rows(); ++k) {
    if (!std::binary_search(inner.begin(), inner.end(), k)) outer.push_back(k);
  }
  const Eigen::VectorXd unit = balancing(A(inner, inner));
  const Matrix own = unit.cwiseInverse().asDiagonal() * A(inner, inner) * unit.asDiagonal();
  const Eigen::VectorXd row_size = own.cwiseAbs().rowwise().sum();
  for (std::size_t m = 0; m < solution.modes.size(); ++m) {
    auto vector = solution.vectors.col(static_cast<Index>(m));
    const Eigen::VectorXcd all = vector;
    const double motion = all(outer).cwiseAbs().maxCoeff();
    if (!(motion <= largest_motion * all(inner).cwiseAbs().maxCoeff())) continue;
    const Eigen::VectorXcd w = unit.cwiseInverse().cast<std::complex<double>>().cwiseProduct(all(inner));
    const std::complex<double> lambda = 2 * std::numbers::pi * solution.modes[m].eigenvalue_hz;
    Eigen::VectorXcd residual = lambda * w;
    residual.real() -= own * w.real();
    residual.imag() -= own * w.imag();
    const Eigen::VectorXd allowed =
        (residual_tolerance * w.cwiseAbs().maxCoeff()) * (row_size.array() + std::abs(lambda)).matrix();
    if (!(residual.cwiseAbs().array() <= allowed.array()).all()) continue;
    for (const Index k : outer) vector(k) = 0;
  }
}

}  // namespace dynalin

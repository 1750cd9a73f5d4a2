#include "modal/still_modes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "modal/mass_root.h"
#include "perturbation/perturbation.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;

// Residuals of a mode that belongs to a system are far below this, those of one that is driven from outside above.
constexpr double residual_tolerance = 1e-11;
// Motions of a still mode are roundings beside its own states.
constexpr double largest_motion = 1e-8;

constexpr Index columns_at_a_time = 64;

// Which of some states have columns of T that move something that has mass.
std::vector<bool> moving_mass(const MassRoot& root, const LinearSystem& linear, const std::vector<Index>& states) {
  const auto n = static_cast<Index>(linear.model.states.size());
  std::vector<bool> moves(states.size(), false);
  if (root.bodies() == 0 || linear.equations->coordinates() == 0) return moves;
  for (Index first = 0; first < static_cast<Index>(states.size()); first += columns_at_a_time) {
    const Index count = std::min(columns_at_a_time, static_cast<Index>(states.size()) - first);
    Eigen::MatrixXcd units = Eigen::MatrixXcd::Zero(n, count);
    for (Index k = 0; k < count; ++k) units(states[static_cast<std::size_t>(first + k)], k) = 1;
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

// Columns of the state matrix; the whole of it is not needed for that.
Matrix state_matrix_columns(const PerturbationEquations& p, const std::vector<Index>& states) {
  Matrix columns(p.states(), static_cast<Index>(states.size()));
  for (Index first = 0; first < columns.cols(); first += columns_at_a_time) {
    const Index count = std::min(columns_at_a_time, columns.cols() - first);
    Matrix of_equations = Matrix::Zero(p.unknowns(), count);
    for (Index k = 0; k < count; ++k) {
      const auto column = p.state_columns() + static_cast<std::int32_t>(states[static_cast<std::size_t>(first + k)]);
      for_each_in_column(p.products(), column, [&](std::int32_t r, double v) { of_equations(r, k) += v; });
    }
    columns.middleCols(first, count) = p.reduced(of_equations);
  }
  return columns;
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

// States that form a system of their own in which nothing that has mass moves, and its matrix.
struct OwnSystem {
  std::vector<Index> states;
  Matrix A;
};

OwnSystem own_system(const Matrix& A, const MassRoot& root, const LinearSystem& linear) {
  std::vector<Index> all(static_cast<std::size_t>(A.rows()));
  std::iota(all.begin(), all.end(), Index{0});
  OwnSystem own{without_influence(A, moving_mass(root, linear, all)), {}};
  own.A = A(own.states, own.states);
  return own;
}

// The same without the state matrix, of the states that may belong to it: those that no mass goes along with.
OwnSystem own_system(const MassRoot& root, const LinearSystem& linear, const EigenSolution& solution) {
  const std::vector<StateLabel>& states = linear.model.states;
  std::vector<Index> candidates;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const bool differential = k >= linear.kinematic_states;
    // A coordinate whose rate stands before it is one of bodies that have mass.
    const bool without_rate =
        linear.first_order > 0 && !differential && !states[k].is_rate && (k == 0 || !states[k - 1].is_rate);
    if (differential || without_rate) candidates.push_back(static_cast<Index>(k));
  }
  // Seldom does a mode consist of them so far that the question comes up.
  const auto still = [&](Index m) {
    Eigen::VectorXd size = solution.vectors.col(m).cwiseAbs();
    double of_candidates = 0;
    for (const Index k : candidates) of_candidates = std::max(of_candidates, std::exchange(size(k), 0.0));
    return size.maxCoeff() <= largest_motion * of_candidates;
  };
  bool any = false;
  for (Index m = 0; m < solution.vectors.cols() && !candidates.empty(); ++m) any = any || still(m);
  if (!any) return {};
  std::vector<bool> moves(states.size(), true);
  const std::vector<bool> of_candidates = moving_mass(root, linear, candidates);
  for (std::size_t k = 0; k < candidates.size(); ++k) moves[static_cast<std::size_t>(candidates[k])] = of_candidates[k];
  // What the others see of them: those that are seen join the others until none is.
  const Matrix columns = state_matrix_columns(*linear.equations, candidates);
  for (bool joined = true; joined;) {
    joined = false;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      const auto k = static_cast<std::size_t>(candidates[c]);
      for (std::size_t r = 0; r < states.size() && !moves[k]; ++r) {
        if (moves[r] && columns(static_cast<Index>(r), static_cast<Index>(c)) != 0.0) moves[k] = joined = true;
      }
    }
  }
  OwnSystem own;
  std::vector<Index> of_columns;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (moves[static_cast<std::size_t>(candidates[c])]) continue;
    own.states.push_back(candidates[c]);
    of_columns.push_back(static_cast<Index>(c));
  }
  own.A = columns(own.states, of_columns);
  return own;
}

}  // namespace

void clear_still_modes(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                       EigenSolution& solution) {
  if (solution.vectors.cols() == 0) return;
  const MassRoot root(system, op);
  const Index states = solution.vectors.rows();
  const auto [inner, A] =
      linear.A.rows() == states ? own_system(linear.model.A, root, linear) : own_system(root, linear, solution);
  if (inner.empty() || static_cast<Index>(inner.size()) == states) return;
  std::vector<Index> outer;
  for (Index k = 0; k < states; ++k) {
    if (!std::binary_search(inner.begin(), inner.end(), k)) outer.push_back(k);
  }
  const Eigen::VectorXd unit = balancing(A);
  const Matrix own = unit.cwiseInverse().asDiagonal() * A * unit.asDiagonal();
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

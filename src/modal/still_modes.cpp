#include "modal/still_modes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
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

// What entries of the state matrix may be of nothing but rounding: a force along the normal of a plane leaves 1e-17 of
// itself in it.
Matrix nothing_but_rounding(const LinearSystem& linear) { return linear.uncertainty + linear.rounding; }

// The same without the state matrix: of some rows, of columns of states that are completed to all unknowns.
Matrix nothing_but_rounding(const PerturbationEquations& p, const std::vector<Index>& rows, const Matrix& columns) {
  constexpr double unit = PerturbationEquations::units_of_rounding * std::numeric_limits<double>::epsilon();
  Matrix units = Matrix::Zero(p.states(), static_cast<Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) units(rows[k], static_cast<Index>(k)) = 1;
  const Matrix left = all_unknowns(p.complete_left(units), units).cwiseAbs();
  Matrix sums = Matrix::Zero(p.unknowns(), columns.cols());
  for_each_entry(p.products(), [&](std::int32_t r, std::int32_t k, double v) {
    sums.row(r) += std::abs(v) * columns.row(k).cwiseAbs();
  });
  const Matrix variances = left.cwiseAbs2().transpose() * p.rounding_variances(columns);
  return variances.cwiseSqrt() + unit * (left.transpose() * sums);
}

// Which columns of the state matrix, of states that are `open`, some rows have more of than rounding. Where there is
// more the largest entries show it, and few rows are looked at.
std::vector<Index> seen_by(const PerturbationEquations& p, std::vector<Index> rows, const Matrix& state_matrix,
                           const std::vector<Index>& open) {
  const Matrix entries = state_matrix(rows, Eigen::all).cwiseAbs();
  std::vector<Index> order(rows.size()), seen;
  std::iota(order.begin(), order.end(), Index{0});
  for (std::size_t first = 0; first < open.size(); first += columns_at_a_time) {
    const std::vector<Index> some(
        open.begin() + static_cast<std::ptrdiff_t>(first),
        open.begin() + static_cast<std::ptrdiff_t>(std::min(first + columns_at_a_time, open.size())));
    const auto columns = Eigen::seqN(static_cast<Index>(first), static_cast<Index>(some.size()));
    Matrix units = Matrix::Zero(p.states(), columns.size());
    for (std::size_t c = 0; c < some.size(); ++c) units(some[c], static_cast<Index>(c)) = 1;
    const Matrix completed = all_unknowns(p.complete(units), units);
    const Eigen::VectorXd largest = entries(Eigen::all, columns).rowwise().maxCoeff();
    std::ranges::stable_sort(order, std::greater{}, [&](Index r) { return largest(r); });
    std::vector<bool> is_seen(some.size(), false);
    for (std::size_t at = 0; at < order.size() && largest(order[at]) > 0; at += columns_at_a_time) {
      const std::vector<Index> here(
          order.begin() + static_cast<std::ptrdiff_t>(at),
          order.begin() + static_cast<std::ptrdiff_t>(std::min(at + columns_at_a_time, order.size())));
      std::vector<Index> states;
      for (const Index r : here) states.push_back(rows[static_cast<std::size_t>(r)]);
      const Matrix rounding = nothing_but_rounding(p, states, completed);
      for (std::size_t c = 0; c < some.size(); ++c) {
        const Eigen::VectorXd column = entries(here, static_cast<Index>(first + c));
        if ((column.array() > rounding.col(static_cast<Index>(c)).array()).any()) is_seen[c] = true;
      }
      if (std::ranges::count(is_seen, false) == 0) break;
    }
    for (std::size_t c = 0; c < some.size(); ++c) {
      if (is_seen[c]) seen.push_back(some[c]);
    }
  }
  return seen;
}

// States that nothing on the way to those marked can see.
std::vector<Index> without_influence(const DenseMatrix& A, const Matrix& rounding, const std::vector<bool>& marked) {
  std::vector<bool> seen = marked;
  std::vector<Index> open, others;
  for (Index k = 0; k < A.rows(); ++k) {
    if (seen[static_cast<std::size_t>(k)]) open.push_back(k);
  }
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    for (Index j = 0; j < A.cols(); ++j) {
      if (std::abs(A(i, j)) <= rounding(i, j) || seen[static_cast<std::size_t>(j)]) continue;
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

OwnSystem own_system(const DenseMatrix& A, const MassRoot& root, const LinearSystem& linear) {
  std::vector<Index> all(static_cast<std::size_t>(A.rows()));
  std::iota(all.begin(), all.end(), Index{0});
  OwnSystem own{without_influence(A, nothing_but_rounding(linear), moving_mass(root, linear, all)), {}};
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
  std::vector<Index> others;
  for (std::size_t k = 0; k < moves.size(); ++k) {
    if (moves[k]) others.push_back(static_cast<Index>(k));
  }
  while (!others.empty()) {
    std::vector<Index> open, of_open;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      if (moves[static_cast<std::size_t>(candidates[c])]) continue;
      open.push_back(candidates[c]);
      of_open.push_back(static_cast<Index>(c));
    }
    others = seen_by(*linear.equations, others, columns(Eigen::all, of_open), open);
    for (const Index k : others) moves[static_cast<std::size_t>(k)] = true;
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
  // A mode with an eigenvalue of its own cannot be mixed with one that moves bodies: what it moves is rounding, however
  // large that is beside states in units of theirs.
  const auto alone = [&](std::size_t m) {
    const std::complex<double> hz = solution.modes[m].eigenvalue_hz;
    return std::ranges::count_if(solution.modes, [&](const EigenMode& other) {
             return std::abs(other.eigenvalue_hz - hz) <= 1e-6 * std::abs(hz);
           }) == 1;
  };
  for (std::size_t m = 0; m < solution.modes.size(); ++m) {
    auto vector = solution.vectors.col(static_cast<Index>(m));
    const Eigen::VectorXcd all = vector;
    const double motion = all(outer).cwiseAbs().maxCoeff();
    const double own_part = all(inner).cwiseAbs().maxCoeff();
    if (!(own_part > 0 && (motion <= largest_motion * own_part || alone(m)))) continue;
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

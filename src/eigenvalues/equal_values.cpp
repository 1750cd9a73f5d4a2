#include "eigenvalues/equal_values.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/arbitrary_vector.h"
#include "base/dense_solvers.h"
#include "eigenvalues/rounding.h"
#include "system/shifted_lu.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using ComplexMatrix = Eigen::MatrixXcd;

constexpr double least_rcond = 1e-6;  // of the products of both bases
constexpr double least_mixed = 1e-3;  // |y_iᴴ x_j| against |y_iᴴ x_i|, where they should be dual
constexpr double beside = 1e-5;       // of the shift from them, relative
constexpr int steps = 4;              // of the iteration for the subspace
// Of T − I/(λ − σ) along the subspace, against 1/|λ − σ|: what is more belongs to a chain.
constexpr double no_chain = 1e-3;

// Whether left and right vectors of some columns are far from dual to each other, or so nearly parallel that duals are
// next to orthogonal.
bool are_mixed(const EigenPairs& pairs, const std::vector<Index>& group) {
  for (const Index i : group) {
    const double unit = std::abs(pairs.left.col(i).dot(pairs.right.col(i)));
    if (!(unit > least_rcond)) return true;
    for (const Index j : group) {
      if (j != i && !(std::abs(pairs.left.col(i).dot(pairs.right.col(j))) <= least_mixed * unit)) return true;
    }
  }
  return false;
}

// Groups of columns whose eigenvalues are equal and whose vectors are mixed.
std::vector<std::vector<Index>> groups_of(const EigenPairs& pairs) {
  const Index count = pairs.right.cols();
  std::vector<bool> taken(static_cast<std::size_t>(count), false);
  std::vector<std::vector<Index>> groups;
  for (Index i = 0; i < count; ++i) {
    if (taken[static_cast<std::size_t>(i)]) continue;
    const Complex v = value(pairs, {i, false});
    std::vector<Index> group;
    for (Index j = i; j < count; ++j) {
      const bool same = pairs.real(i) == pairs.real(j) && !taken[static_cast<std::size_t>(j)];
      if (same && std::abs(value(pairs, {j, false}) - v) <= equal_values * std::abs(v)) group.push_back(j);
    }
    for (const Index j : group) taken[static_cast<std::size_t>(j)] = true;
    if (group.size() > 1 && are_mixed(pairs, group)) groups.push_back(std::move(group));
  }
  return groups;
}

class Subspaces {
 public:
  explicit Subspaces(const PerturbationEquations& equations)
      : states_(equations.states()),
        unknowns_(equations.unknowns()),
        lu_(equations.products(), static_cast<std::int32_t>(equations.states())) {}

  // Nothing changes where the eigenvalue is defective, or where that cannot be told.
  void separate(const std::vector<Index>& group, EigenPairs& pairs) {
    const auto k = static_cast<Index>(group.size());
    const bool real = pairs.real(group.front());
    Complex mean = 0;
    for (const Index i : group) mean += value(pairs, {i, false}) / static_cast<double>(k);
    const Complex shift = (1 + beside) * mean;
    if (!lu_.factor(shift)) return;
    ComplexMatrix X = start(k, real, 900), Y = start(k, real, 950);
    for (int step = 0; step < steps; ++step) {
      X = orthonormal(applied(X, false));
      Y = orthonormal(applied(Y, true));
      if (!X.allFinite() || !Y.allFinite()) return;
    }
    const Eigen::PartialPivLU<ComplexMatrix> unit(ComplexMatrix(Y.adjoint() * X));
    if (!(unit.rcond() > least_rcond)) return;
    ComplexMatrix T = unit.solve(Y.adjoint() * applied(X, false));
    const Complex each = 1.0 / (mean - shift);
    T.diagonal().array() -= each;
    if (!(T.norm() <= no_chain * std::abs(each))) return;
    // Dual to X.
    Y = Y * unit.inverse().adjoint();
    for (Index c = 0; c < k; ++c) {
      pairs.right.col(group[static_cast<std::size_t>(c)]) = X.col(c);
      pairs.left.col(group[static_cast<std::size_t>(c)]) = Y.col(c).normalized();
    }
  }

 private:
  ComplexMatrix start(Index columns, bool real, unsigned first) const {
    ComplexMatrix X(states_, columns);
    for (Index c = 0; c < columns; ++c) {
      X.col(c) = arbitrary_vector(states_, first + static_cast<unsigned>(c));
      if (real) X.col(c).imag().setZero();
    }
    return X;
  }
  // (A − σ)⁻¹ of columns of states, or its adjoint.
  ComplexMatrix applied(const ComplexMatrix& X, bool adjoint) const {
    ComplexMatrix out(X.rows(), X.cols());
    for (Index c = 0; c < X.cols(); ++c) {
      Eigen::VectorXcd w = Eigen::VectorXcd::Zero(unknowns_);
      w.tail(states_) = X.col(c);
      adjoint ? lu_.solve_adjoint(w) : lu_.solve(w);
      out.col(c) = w.tail(states_);
    }
    return out;
  }
  static ComplexMatrix orthonormal(const ComplexMatrix& X) {
    return columns_of_q(Eigen::HouseholderQR<ComplexMatrix>(X), X.cols());
  }

  const Index states_, unknowns_;
  ShiftedLu lu_;
};

}  // namespace

void separate_equal_values(const PerturbationEquations& equations, EigenPairs& pairs) {
  const auto groups = groups_of(pairs);
  if (groups.empty()) return;
  Subspaces subspaces(equations);
  for (const std::vector<Index>& group : groups) subspaces.separate(group, pairs);
}

}  // namespace dynalin

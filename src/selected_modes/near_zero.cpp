#include "selected_modes/near_zero.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/dense_solvers.h"
#include "eigenvalues/zero_modes.h"
#include "perturbation/perturbation.h"
#include "structural_zeros/null_space.h"
#include "structural_zeros/structural_zeros.h"

namespace dynalin {

namespace {

using Matrix = Eigen::MatrixXd;
using RealVector = Eigen::VectorXd;
using Index = Eigen::Index;

constexpr double rounding_of_directions = 1e-11;  // in the changes of single elements, relative to their own size
constexpr double no_link = 1e-8;                  // of a chain, in units of the states

class Search {
 public:
  Search(const System& system, const Perturbation& perturbation, const Eigen::MatrixXcd& basis, const RealVector& units)
      : equations_(*perturbation.equations), zeros_(system, perturbation), units_(units) {
    // A real basis of the same space: it holds the conjugate of each of its vectors.
    Matrix both(basis.rows(), 2 * basis.cols());
    both << basis.real(), basis.imag();
    Q_ = range(units.cwiseInverse().asDiagonal() * both);
    Matrix displacements = Q_;
    for (std::size_t k = 0; k < perturbation.model.states.size(); ++k) {
      if (k >= perturbation.kinematic_states || perturbation.model.states[k].is_rate)
        displacements.row(static_cast<Index>(k)).setZero();
    }
    displacements_ = units.asDiagonal() * range(displacements);
    found_.directions = Matrix(basis.rows(), 0);
  }

  NearZero run() {
    while (found_.count() < Q_.cols() && (take_states() || take_motions())) continue;
    const Index z = found_.count();
    const Matrix in_units = units_.cwiseInverse().asDiagonal() * found_.directions;
    const Matrix images = units_.cwiseInverse().asDiagonal() * image(found_.directions);
    found_.chains = Matrix::Zero(z, z);
    if (z == 0) return std::move(found_);
    const Matrix N = in_units.colPivHouseholderQr().solve(images);
    const RealVector size = in_units.colwise().norm();
    double largest = 0;
    for (Index j = 0; j < z; ++j) {
      for (Index i = 0; i < z; ++i) largest = std::max(largest, std::abs(N(i, j)) * size(i) / size(j));
    }
    for (Index j = 0; j < z; ++j) {
      for (Index i = 0; i < j; ++i) {
        if (std::abs(N(i, j)) * size(i) / size(j) > no_link * largest) found_.chains(i, j) = N(i, j);
      }
    }
    return std::move(found_);
  }

 private:
  // An orthonormal basis of what columns of about unit length span.
  static Matrix range(const Matrix& columns) {
    const Eigen::ColPivHouseholderQR<Matrix> qr(columns);
    return columns_of_q(qr, independent_columns(qr));
  }
  Matrix image(const Matrix& x) const {  // A x
    const Matrix a = equations_.complete(x);
    Matrix rates = Matrix::Zero(equations_.unknowns(), x.cols()), w(equations_.unknowns(), x.cols());
    w << a, x;
    for (Index c = 0; c < x.cols(); ++c) {
      equations_.products().multiply_add({w.col(c).data(), static_cast<std::size_t>(w.rows())},
                                         {rates.col(c).data(), static_cast<std::size_t>(w.rows())});
    }
    return rates.bottomRows(equations_.states());
  }

  // States whose column of A is exactly zero but for zeros that were taken before.
  bool take_states() {
    std::vector<Index> candidates;
    for (Index k = 0; k < Q_.rows(); ++k) {
      if (!is_taken(k) && std::abs(Q_.row(k).norm() - 1) < beside_its_space) candidates.push_back(k);
    }
    if (candidates.empty()) return false;
    Matrix unit = Matrix::Zero(Q_.rows(), static_cast<Index>(candidates.size()));
    for (std::size_t c = 0; c < candidates.size(); ++c) unit(candidates[c], static_cast<Index>(c)) = 1;
    Matrix images = image(unit);
    for (const Index k : taken_) images.row(k).setZero();
    bool any = false;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      const auto column = static_cast<Index>(c);
      if (!images.col(column).isZero(0) || !take(unit.col(column))) continue;
      fresh_.push_back(candidates[c]), any = true;
    }
    taken_.insert(taken_.end(), fresh_.begin(), fresh_.end());
    fresh_.clear();
    return any;
  }
  bool is_taken(Index k) const { return std::find(taken_.begin(), taken_.end(), k) != taken_.end(); }

  bool take_motions() {
    const Matrix motions = zeros_.beyond(found_.directions, displacements_, rounding_of_directions);
    bool any = false;
    const std::vector<bool>& driven = zeros_.driven();
    Matrix seen = Q_;
    for (Index k = 0; k < seen.rows(); ++k) {
      if (driven[static_cast<std::size_t>(k)]) seen.row(k).setZero();
    }
    const Eigen::ColPivHouseholderQR<Matrix> fit(seen);
    for (Index c = 0; c < motions.cols(); ++c) {
      RealVector v = motions.col(c).cwiseQuotient(units_);
      for (Index k = 0; k < v.size(); ++k) {
        if (driven[static_cast<std::size_t>(k)]) v(k) = 0;
      }
      // What it does to states that only follow it.
      const RealVector whole = Q_ * fit.solve(v);
      for (Index k = 0; k < v.size(); ++k) {
        if (driven[static_cast<std::size_t>(k)]) v(k) = whole(k);
      }
      any = take(v.cwiseProduct(units_)) || any;
    }
    return any;
  }

  // If it is in the subspace and beyond what was taken before.
  bool take(const RealVector& direction) {
    RealVector v = direction.cwiseQuotient(units_);
    const double size = v.norm();
    if (!(size > 0) || !((v - Q_ * (Q_.transpose() * v)).norm() <= beside_its_space * size)) return false;
    if (found_.count() > 0) {
      const Matrix before = units_.cwiseInverse().asDiagonal() * found_.directions;
      const RealVector rest = v - before * before.colPivHouseholderQr().solve(v);
      if (!(rest.norm() > another_direction * size)) return false;
    }
    Matrix more(direction.size(), found_.count() + 1);
    more << found_.directions, direction / size;
    found_.directions = std::move(more);
    return true;
  }

  const PerturbationEquations& equations_;
  const StructuralZeros zeros_;
  const RealVector units_;
  Matrix Q_;              // in units
  Matrix displacements_;  // that there are in it
  std::vector<Index> taken_, fresh_;
  NearZero found_;
};

}  // namespace

Matrix NearZero::vectors() const {
  Matrix v = directions * last_links(chains);
  v.colwise().normalize();
  return v;
}

NearZero all_structural_zeros(const LinearSystem& linear) {
  const ZeroModes zero = split_zero_modes(linear.A, linear.rounding, linear.structural_zeros.get());
  return {zero.right().leftCols(zero.count), zero.block.topLeftCorner(zero.count, zero.count)};
}

NearZero structural_zeros_near(const System& system, const Perturbation& perturbation, const Eigen::MatrixXcd& basis,
                               const RealVector& units) {
  return Search(system, perturbation, basis, units).run();
}

}  // namespace dynalin

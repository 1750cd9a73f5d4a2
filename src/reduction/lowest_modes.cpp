#include "reduction/lowest_modes.h"

#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace dynalin::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Up to so many freedoms with mass, dense matrices of them are faster than a subspace.
constexpr Index dense_up_to = 400;
// 1/ω² below this part of the largest is rounding of a freedom without mass.
constexpr double massless_ratio = 1e-13;
// Eigenvalues of the mass, with ones in its diagonal, that are rounding of entries as other programs print them.
constexpr double rounding_of_mass = 1e-9, negative_mass = 1e-8;
// Frequencies that differ by less belong to one mode, as those of a square section.
constexpr double same_square = 1e-6;

// K⁻¹ on vectors that are orthogonal in M to modes found before; units of 1/ω² are such that the largest is near 1.
struct Inverse {
  using Scalar = double;
  const InertiaFactors& factors;
  const SparseMatrix& mass;
  const MatrixXd& found;
  MatrixXd mass_found;
  double unit = 1;

  Index rows() const { return mass.rows(); }
  Index cols() const { return mass.cols(); }
  void set_shift(double) {}
  void perform_op(const double* x_in, double* y_out) const {
    Eigen::Map<VectorXd> y(y_out, rows());
    y = unit * Eigen::Map<const VectorXd>(x_in, rows());
    factors.solve(y);
    if (found.cols() > 0) y -= found * (mass_found.transpose() * y);
  }
};

struct Mass {
  using Scalar = double;
  const SparseMatrix& mass;
  Index rows() const { return mass.rows(); }
  Index cols() const { return mass.cols(); }
  void perform_op(const double* x_in, double* y_out) const {
    Eigen::Map<VectorXd>(y_out, rows()).noalias() = mass * Eigen::Map<const VectorXd>(x_in, rows());
  }
};

class Search {
 public:
  Search(const SparseMatrix& stiffness, const SparseMatrix& mass, const InertiaFactors& factors)
      : stiffness_(stiffness), mass_(mass), factors_(factors) {}

  // All modes. With M = B Bᵀ, of as many columns as M has rank, 1/ω² are the eigenvalues of Bᵀ K⁻¹ B: shapes without
  // mass, however soft they are, have no part in it.
  tl::expected<LowestModes, std::string> all(const std::vector<Index>& with_mass) const {
    const auto r = static_cast<Index>(with_mass.size());
    MatrixXd mass(r, r);
    for (Index c = 0; c < r; ++c) mass.col(c) = VectorXd(mass_.col(with_mass[static_cast<std::size_t>(c)]))(with_mass);
    const VectorXd unit = mass.diagonal().cwiseSqrt();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> of_mass(
        MatrixXd(unit.cwiseInverse().asDiagonal() * mass * unit.cwiseInverse().asDiagonal()));
    const VectorXd& masses = of_mass.eigenvalues();
    if (masses[0] < -negative_mass * masses[r - 1])
      return tl::unexpected<std::string>("the mass has a negative eigenvalue");
    Index none = 0;
    while (masses[none] <= rounding_of_mass * masses[r - 1]) ++none;
    const Index rank = r - none;
    const MatrixXd B =
        unit.asDiagonal() * of_mass.eigenvectors().rightCols(rank) * masses.tail(rank).cwiseSqrt().asDiagonal();
    MatrixXd flexible = MatrixXd::Zero(mass_.rows(), rank);
    for (Index k = 0; k < r; ++k) flexible.row(with_mass[static_cast<std::size_t>(k)]) = B.row(k);
    factors_.solve(flexible);
    const MatrixXd H = B.transpose() * flexible(with_mass, Eigen::all);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(0.5 * (H + H.transpose())));
    const VectorXd& inverse_squares = eigen.eigenvalues();
    if (!(inverse_squares[0] > -massless_ratio * inverse_squares[rank - 1]))
      return tl::unexpected<std::string>("the stiffness is not positive definite");
    Index count = 0;
    while (count < rank && inverse_squares[rank - 1 - count] > massless_ratio * inverse_squares[rank - 1]) ++count;
    LowestModes modes;
    modes.squares = inverse_squares.reverse().head(count).cwiseInverse();
    modes.shapes = flexible * (eigen.eigenvectors().rowwise().reverse().leftCols(count) * modes.squares.asDiagonal());
    return modes;
  }

  // Adds the lowest modes that are not there yet, at least `count` of them if the subspace finds so many.
  tl::expected<void, std::string> add(Index count) {
    const Index n = mass_.rows();
    Inverse inverse{factors_, mass_, modes_.shapes, mass_ * modes_.shapes, 1.0};
    const VectorXd start = random_vector(n);
    inverse.unit = unit_of(inverse, start);
    if (!(inverse.unit > 0) || !std::isfinite(inverse.unit)) return {};
    Mass mass{mass_};
    const Index wanted = std::min(count, n - 1), space = std::min(n, std::max(2 * wanted, wanted + 20));
    try {
      using Solver = Spectra::SymGEigsShiftSolver<Inverse, Mass, Spectra::GEigsMode::ShiftInvert>;
      Solver solver(inverse, mass, wanted, space, 0.0);
      solver.init(start.data());
      constexpr Index most_restarts = 300;
      constexpr double to = 1e-10;
      solver.compute(Spectra::SortRule::LargestMagn, most_restarts, to);
      if (solver.info() != Spectra::CompInfo::Successful && solver.eigenvalues().size() == 0)
        return tl::unexpected<std::string>("no mode converged");
      take(solver.eigenvectors());
    } catch (const std::exception& e) {
      return tl::unexpected(fmt::format("the search for modes failed: {}", e.what()));
    }
    return {};
  }

  Index below(double square) const {
    return std::count_if(modes_.squares.begin(), modes_.squares.end(), [&](double s) { return s < square; });
  }
  Index counted_below(double square) const { return InertiaFactors(stiffness_ - square * mass_).negative(); }
  const VectorXd& squares() const { return modes_.squares; }
  LowestModes lowest(Index count) const { return {modes_.squares.head(count), modes_.shapes.leftCols(count)}; }

 private:
  VectorXd random_vector(Index n) {
    VectorXd v(n);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (double& x : v) x = any(random_);
    return v;
  }
  // ω² near the lowest that is not found.
  double unit_of(const Inverse& inverse, VectorXd v) const {
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      const VectorXd load = mass_ * v;
      const double size = std::sqrt(std::max(0.0, v.dot(load)));
      VectorXd next(v.size());
      inverse.perform_op(load.data(), next.data());
      square = size / std::sqrt(std::max(0.0, next.dot(mass_ * next)));
      v = next / next.norm();
    }
    return square;
  }
  // One step of inverse iteration takes out what the mass cannot see, and all found together are made orthogonal.
  void take(const MatrixXd& vectors) {
    MatrixXd all(mass_.rows(), modes_.shapes.cols() + vectors.cols());
    all << modes_.shapes, mass_ * vectors;
    factors_.solve(all.rightCols(vectors.cols()));
    const VectorXd size = (all.transpose() * (mass_ * all)).diagonal().cwiseSqrt().cwiseMax(1e-300);
    all = all * size.cwiseInverse().asDiagonal();
    const MatrixXd m = all.transpose() * (mass_ * all), k = all.transpose() * (stiffness_ * all);
    // Directions that two runs share are left out.
    const Eigen::SelfAdjointEigenSolver<MatrixXd> overlap(m);
    Index first = 0;
    while (first < m.cols() && overlap.eigenvalues()[first] < 1e-6) ++first;
    const Index kept = m.cols() - first;
    const MatrixXd basis = overlap.eigenvectors().rightCols(kept) *
                           overlap.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
    const MatrixXd reduced = basis.transpose() * k * basis;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(MatrixXd(0.5 * (reduced + reduced.transpose())));
    modes_.squares = ritz.eigenvalues();
    modes_.shapes = all * (basis * ritz.eigenvectors());
  }

  const SparseMatrix& stiffness_;
  const SparseMatrix& mass_;
  const InertiaFactors& factors_;
  LowestModes modes_{VectorXd(0), MatrixXd(mass_.rows(), 0)};
  std::mt19937 random_{1};
};

// The first `count` with all that have the frequency of the last one; 0 if nothing separates them from what follows.
Index whole_modes(const VectorXd& squares, Index count) {
  while (count < squares.size() && squares[count] - squares[count - 1] <= same_square * squares[count]) ++count;
  return count < squares.size() ? count : 0;
}

constexpr int most_searches = 6;
constexpr Index spare = 4;

tl::unexpected<std::string> missed(Index found, Index counted) {
  return tl::unexpected(fmt::format("{} modes were found where the signs of K - s M count {}", found, counted));
}

}  // namespace

tl::expected<LowestModes, std::string> lowest_modes(const SparseMatrix& stiffness, const SparseMatrix& mass,
                                                    const InertiaFactors& of_stiffness, const ModeRequest& request) {
  std::vector<Index> with_mass;
  const VectorXd diagonal = mass.diagonal();
  for (Index k = 0; k < diagonal.size(); ++k) {
    if (diagonal[k] > 0) with_mass.push_back(k);
  }
  const auto r = static_cast<Index>(with_mass.size());
  if (r == 0 || request.count <= 0) return LowestModes{VectorXd(0), MatrixXd(mass.rows(), 0)};
  Search search(stiffness, mass, of_stiffness);
  const bool limited = std::isfinite(request.below);
  Index wanted = std::min(request.count, r);
  bool all_below = false;  // as many are wanted as are below the limit
  if (r > dense_up_to && limited) {
    const Index below = search.counted_below(request.below);
    all_below = below <= wanted;
    wanted = std::min(wanted, below);
  }
  if (r <= dense_up_to || 3 * (wanted + spare) > r) {
    auto modes = search.all(with_mass);
    if (!modes) return modes;
    Index kept = std::min(wanted, modes->squares.size());
    while (kept > 0 && modes->squares[kept - 1] > request.below) --kept;
    if (kept > 0 && kept < modes->squares.size() && modes->squares[kept] <= request.below) {
      const Index whole = whole_modes(modes->squares, kept);
      kept = whole ? whole : modes->squares.size();
    }
    return LowestModes{modes->squares.head(kept), modes->shapes.leftCols(kept)};
  }
  if (wanted == 0) return LowestModes{VectorXd(0), MatrixXd(mass.rows(), 0)};
  Index found = 0, counted = 0;
  for (int k = 0; k < most_searches; ++k) {
    // Where the last run left some out there are as many still to be found, and those that separate them.
    if (const auto added = search.add(k == 0 ? wanted + spare : std::max(counted - found, Index{1}) + spare); !added)
      return tl::unexpected(added.error());
    if (all_below && search.below(request.below) == wanted) return search.lowest(wanted);
    const Index whole = search.squares().size() > wanted ? whole_modes(search.squares(), wanted) : 0;
    if (whole == 0) {
      found = counted = search.squares().size();
      continue;
    }
    const double between = 0.5 * (search.squares()[whole - 1] + search.squares()[whole]);
    found = whole, counted = search.counted_below(between);
    if (found == counted) return search.lowest(std::min(whole, limited ? search.below(request.below) : whole));
  }
  return missed(found, counted);
}

}  // namespace dynalin::reduction

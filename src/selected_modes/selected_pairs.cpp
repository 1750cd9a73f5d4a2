#include "selected_modes/selected_pairs.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense_products.h"
#include "base/dense_solvers.h"
#include "eigenvalues/clustered_schur.h"
#include "eigenvalues/rounding.h"
#include "selected_modes/subspace_pencil.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using ComplexMatrix = Eigen::MatrixXcd;
using ComplexVector = Eigen::VectorXcd;

// How nearly parts of a basis may depend on each other before they become one.
constexpr double most_oblique = 1e4;

ComplexMatrix complement(const ComplexMatrix& columns) {
  const Eigen::HouseholderQR<ComplexMatrix> qr(columns);
  const ComplexMatrix Q = columns_of_q(qr, columns.rows());
  return Q.rightCols(columns.rows() - columns.cols());
}

// Bases without the zeros, and dual to each other.
std::optional<Subspace> without_zeros(const ShiftInverse& op, const TwoSided& of, const NearZero& zero) {
  const Eigen::VectorXd& unit = op.units();
  Subspace s;
  s.V = zero.directions, s.N = zero.chains;
  const Index z = zero.count(), p = of.Q.cols() - z;
  ComplexMatrix Q = of.Q, P = of.P, BR = of.B, alpha(of.Q.cols(), 0);
  ComplexMatrix R = ComplexMatrix::Identity(of.Q.cols(), of.Q.cols());
  if (z > 0) {
    const ComplexMatrix V = unit.cwiseInverse().asDiagonal() * zero.directions.cast<Complex>();
    alpha = adjoint_product(of.Q, V);
    R = complement(alpha);
    Q = product(of.Q, R);
    P = product(of.P, complement(adjoint_product(of.P, V)));
    BR = of.B * R;
  }
  const ComplexMatrix K = adjoint_product(P, Q);
  const Eigen::PartialPivLU<ComplexMatrix> lu(K);
  if (p > 0 && !(lu.rcond() > 1e-13)) return std::nullopt;
  // (P K⁻ᴴ)ᴴ Q = K⁻¹ Pᴴ Q
  P = product(P, lu.inverse().adjoint());
  s.B = adjoint_product(P, product(of.Q, BR));
  s.C = z > 0 ? ComplexMatrix(alpha.colPivHouseholderQr().solve(ComplexMatrix(BR - R * s.B))) : ComplexMatrix(0, p);
  s.X = unit.asDiagonal() * Q;
  s.Y = unit.cwiseInverse().asDiagonal() * P;
  return s;
}

// Brings B to blocks, one for each eigenvalue or cluster whose vectors are no good basis.
bool split(Subspace& s) {
  const Index p = s.B.rows();
  // Of undamped modes B is i times a real matrix: as a real one it leaves real and imaginary parts of the bases apart.
  const Complex factor = (s.B.real().array() == 0).all() ? Complex(0, 1) : Complex(1, 0);
  const LongComplexMatrix B = (s.B / factor).cast<std::complex<long double>>();
  ClusteredSchur schur;
  if (!schur.compute(B)) return false;
  LongComplexMatrix Z, inverse;
  for (;;) {
    Z = schur.bases();
    inverse = Z.partialPivLu().inverse();
    const Eigen::VectorXd rows = inverse.cwiseAbs().cast<double>().rowwise().norm();
    const double most = rows.allFinite() && Z.allFinite() ? rows.maxCoeff() : std::numeric_limits<double>::infinity();
    if (most <= most_oblique || schur.clusters() == 1) break;
    // The worst with its neighbour; the closest two where that cannot be told.
    Index a = 0, b = -1;
    const auto gap = [&](Index i, Index j) { return std::abs(schur.mean(i) - schur.mean(j)); };
    if (std::isfinite(most)) {
      Index worst = 0;
      rows.maxCoeff(&worst);
      a = schur.cluster_of(worst);
      for (Index j = 0; j < schur.clusters(); ++j) {
        if (j != a && (b < 0 || gap(a, j) < gap(a, b))) b = j;
      }
    } else {
      for (Index i = 0; i < schur.clusters(); ++i) {
        for (Index j = 0; j < i; ++j) {
          if (b < 0 || gap(i, j) < gap(a, b)) a = i, b = j;
        }
      }
    }
    std::vector<Index> number;
    for (Index k = 0; k < schur.clusters(); ++k) number.push_back(k == std::max(a, b) ? std::min(a, b) : k);
    schur.join(number);
  }
  if (!inverse.allFinite()) return false;
  LongComplexMatrix D = times(inverse, times(B, Z));
  for (Index j = 0; j < p; ++j) {
    for (Index i = 0; i < p; ++i) {
      if (schur.cluster_of(i) != schur.cluster_of(j)) D(i, j) = 0;
    }
  }
  const ComplexMatrix right = Z.cast<Complex>(), left = inverse.adjoint().cast<Complex>();
  s.B = factor * D.cast<Complex>();
  s.X = product(s.X, right);
  s.Y = product(s.Y, left);
  s.C = (s.C * right).eval();
  return true;
}

bool meet(Complex a, Complex b, double radii) { return std::abs(a - b) <= radii * (1 + 1e-9); }

// One entry for each eigenvalue with Im ≥ 0 of discs that are their own mirror images, or have one, or none.
class Mirror {
 public:
  // `residual` is A X − X B − V C.
  Mirror(const Subspace& s, const ComplexMatrix& residual, const NearZero& zero, std::vector<InclusionDisc> discs)
      : s_(s), residual_(residual), zero_(zero), discs_(std::move(discs)) {}

  // Nothing if `both_members` of pairs ought to be here, and one stands alone: bounds do not hold then.
  std::optional<BoundedPairs> run(bool both_members) {
    std::vector<bool> done(discs_.size(), false);
    for (std::size_t i = 0; i < discs_.size(); ++i) {
      if (done[i]) continue;
      std::vector<std::size_t> met;
      for (std::size_t j = 0; j < discs_.size(); ++j) {
        if (!done[j] && meet(std::conj(discs_[i].centre), discs_[j].centre, discs_[i].radius + discs_[j].radius))
          met.push_back(j);
      }
      const bool itself = std::find(met.begin(), met.end(), i) != met.end();
      if (met.empty()) {
        if (both_members) return std::nullopt;
        add(i, discs_[i].centre.imag() < 0, discs_[i].centre, discs_[i].radius, discs_[i].count);
      } else if (!itself && met.size() == 1 && discs_[met.front()].count == discs_[i].count) {
        const std::size_t upper = discs_[i].centre.imag() > 0 ? i : met.front();
        add(upper, false, discs_[upper].centre, discs_[upper].radius, discs_[upper].count);
        done[met.front()] = true;
      } else if (itself && met.size() == 1) {
        const InclusionDisc& d = discs_[i];
        add(i, false, d.centre.real(), d.radius + std::abs(d.centre.imag()), d.count);
      } else {
        add_together(i, met, done);
      }
      done[i] = true;
    }
    take_shapes();
    return std::move(out_);
  }

 private:
  // Discs that cannot be told apart from each other's mirror images hold their eigenvalues together, on the axis.
  void add_together(std::size_t i, std::vector<std::size_t> met, std::vector<bool>& done) {
    if (std::find(met.begin(), met.end(), i) == met.end()) met.push_back(i);
    Complex sum = 0;
    Index count = 0;
    for (const std::size_t k : met) {
      sum += discs_[k].centre * static_cast<double>(discs_[k].count);
      count += discs_[k].count;
    }
    const double centre = sum.real() / static_cast<double>(count);
    double radius = 0;
    for (const std::size_t k : met) radius = std::max(radius, std::abs(discs_[k].centre - centre) + discs_[k].radius);
    for (const std::size_t k : met) {
      add(k, false, centre, radius, discs_[k].count, count);
      done[k] = true;
    }
  }
  void add(std::size_t at, bool conjugate, Complex value, double radius, Index count, Index cluster = 0) {
    const InclusionDisc& d = discs_[at];
    const Index together = cluster > 0 ? cluster : count;
    for (Index k = 0; k < count; ++k) {
      out_.pairs.values.push_back(conjugate ? std::conj(value) : value);
      out_.trust.push_back({radius + 2 * eps * std::abs(value), 0, together == 1, together});
      shares_.push_back({d.right.col(k), d.left.col(k), value, d.centre, conjugate,
                         zero_.count() > 0 && std::abs(d.centre) <= d.radius});
    }
  }
  // Vectors of all at once: each pass through the bases takes as long as reading them.
  void take_shapes() {
    const Index p = s_.X.cols(), columns = static_cast<Index>(shares_.size()), z = zero_.count();
    ComplexMatrix right(p, columns), left(p, columns), rest(p, columns), of_zeros(z, columns), in_images(z, columns);
    for (Index k = 0; k < columns; ++k) {
      const Share& share = shares_[static_cast<std::size_t>(k)];
      right.col(k) = share.right, left.col(k) = share.left;
      rest.col(k) = s_.B * share.right - share.value * share.right;
      if (z == 0) continue;
      // The part of V, where there is one, takes along what A X has of it.
      const ComplexVector along = s_.C * share.right;
      of_zeros.col(k).setZero(), in_images.col(k).setZero();
      if (share.among_zeros) {
        in_images.col(k) = along;
      } else {
        ComplexMatrix shifted = zero_.chains.cast<Complex>();
        shifted.diagonal().array() -= share.centre;
        of_zeros.col(k) = shifted.partialPivLu().solve(ComplexVector(-along));
      }
    }
    ComplexMatrix x = product(s_.X, right), residual = product(residual_, right) + product(s_.X, rest);
    if (z > 0) {
      x += real_product(s_.V, of_zeros);
      residual += real_product(s_.V, in_images);
    }
    ComplexMatrix y = product(s_.Y, left);
    for (Index k = 0; k < columns; ++k) {
      out_.residual.push_back(residual.col(k).norm() / x.col(k).norm());
      if (!shares_[static_cast<std::size_t>(k)].conjugate) continue;
      x.col(k) = x.col(k).conjugate().eval(), y.col(k) = y.col(k).conjugate().eval();
    }
    x.colwise().normalize(), y.colwise().normalize();
    out_.pairs.right = std::move(x), out_.pairs.left = std::move(y);
  }

  // What a vector has of the bases.
  struct Share {
    ComplexVector right, left;
    Complex value, centre;
    bool conjugate, among_zeros;
  };

  const Subspace& s_;
  const ComplexMatrix& residual_;
  const NearZero& zero_;
  const std::vector<InclusionDisc> discs_;
  std::vector<Share> shares_;
  BoundedPairs out_;
};

}  // namespace

std::optional<BoundedPairs> bounded_pairs(const PerturbationEquations& equations, const ShiftInverse& op, TwoSided of,
                                          const NearZero& zero, double distance) {
  if (of.Q.cols() <= zero.count()) {
    BoundedPairs none;
    none.pairs.right.resize(of.Q.rows(), 0), none.pairs.left.resize(of.Q.rows(), 0);
    return none;
  }
  std::optional<Subspace> s = without_zeros(op, of, zero);
  // Of large models these are a good part of the memory that measuring takes.
  of.Q.resize(0, 0), of.P.resize(0, 0);
  if (!s || !split(*s)) return std::nullopt;
  double reach = 0;
  for (const Complex& v : s->B.diagonal()) reach = std::max(reach, std::abs(v - op.shift()));
  const SubspacePencil pencil = measured(equations, op, *s, distance, reach);
  if (!pencil.uncertainty.allFinite()) return std::nullopt;
  auto discs = inclusion_discs(pencil.value, pencil.uncertainty, false);
  if (!discs) return std::nullopt;
  return Mirror(*s, pencil.residual, zero, std::move(*discs)).run(of.both_members);
}

BoundedPairs pairs_without_bounds(const ShiftInverse& op, const ComplexMatrix& Q, const ComplexMatrix& B) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  BoundedPairs out;
  out.pairs.right.resize(Q.rows(), 0), out.pairs.left.resize(Q.rows(), 0);
  if (B.rows() == 0) return out;
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(B);
  std::vector<Index> upper;
  for (Index k = 0; k < B.rows(); ++k) {
    if (solver.eigenvalues()(k).imag() >= 0) upper.push_back(k);
  }
  for (const Index k : upper) out.pairs.values.push_back(solver.eigenvalues()(k));
  const ComplexMatrix chosen = solver.eigenvectors()(Eigen::all, upper);
  out.pairs.right = op.units().asDiagonal() * product(Q, chosen);
  out.pairs.right.colwise().normalize();
  out.pairs.left = ComplexMatrix::Zero(Q.rows(), chosen.cols());
  out.trust.assign(upper.size(), {unknown, 0, false, 1});
  out.residual.assign(upper.size(), unknown);
  return out;
}

}  // namespace dynalin

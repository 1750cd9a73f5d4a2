#include "eigenvalues/inclusion.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "eigenvalues/balancing.h"
#include "eigenvalues/clustered_schur.h"
#include "eigenvalues/disc_vectors.h"
#include "eigenvalues/index.h"
#include "eigenvalues/resolvent_bounds.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Complex = std::complex<double>;
using LongComplex = std::complex<long double>;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;

constexpr double most_inverse_defect = 0.05;  // of a basis times its computed inverse
constexpr int most_rounds_of_weights = 300;

class Inclusion {
 public:
  Inclusion(const LongComplexMatrix& M, const Matrix& uncertainty, bool real)
      : n_(M.rows()), real_(real), M_(M), U_(uncertainty), scale_(Eigen::VectorXd::Ones(n_)) {}

  std::optional<std::vector<InclusionDisc>> run() {
    balance();
    if (!schur_.compute(M_)) return std::nullopt;
    for (;;) {
      join_.resize(at(blocks()));
      std::iota(join_.begin(), join_.end(), Index{0});
      if (measure() && include() && mirrored()) break;
      if (!merge()) return std::nullopt;
    }
    return discs();
  }

 private:
  Index blocks() const { return schur_.clusters(); }
  Index first(Index i) const { return schur_.first(i); }
  Index size(Index i) const { return schur_.size(i); }

  // By powers of two: exact. What is uncertain weighs with what is known: an entry that is nothing but rounding would
  // be made as large as the others, and its uncertainty far larger.
  void balance() {
    for (bool changed = true; changed;) {
      changed = false;
      for (Index i = 0; i < n_; ++i) {
        long double row = 0, column = 0;
        for (Index j = 0; j < n_; ++j) {
          if (j == i) continue;
          row += std::abs(M_(i, j)) + static_cast<long double>(U_(i, j));
          column += std::abs(M_(j, i)) + static_cast<long double>(U_(j, i));
        }
        if (row == 0 || column == 0) continue;
        const int exponent = static_cast<int>(std::lround(std::log2(row / column) / 2));
        const long double f = std::ldexp(1.0L, exponent);
        if (exponent == 0 || column * f + row / f > 0.95L * (column + row)) continue;
        changed = true;
        M_.col(i) *= f, M_.row(i) /= f;
        U_.col(i) *= static_cast<double>(f), U_.row(i) /= static_cast<double>(f);
        scale_(i) *= static_cast<double>(f);
      }
    }
  }

  bool measure() {
    Z_ = schur_.bases();  // what is missing from the Schur form is found again in E
    if (!Z_.allFinite()) return join_equal();
    inverse_ = Z_.partialPivLu().inverse();
    const double g = rounding_of_sum(n_);
    const Matrix right = sizes(Z_), left = sizes(inverse_), of_M = sizes(M_);
    if (!inverse_.allFinite()) return join_closest();
    LongComplexMatrix defect = times(inverse_, Z_);
    defect.diagonal().array() -= LongComplex(1);
    const Matrix P = (sizes(defect) + g * left * right) * upward;
    const double off = P.rowwise().sum().maxCoeff();
    if (!(off < most_inverse_defect)) return join_oblique(left);
    H_ = times(inverse_, times(M_, Z_));
    const Matrix rounded = left * ((U_ + 2 * g * of_M) * right) * upward;
    // Z⁻¹ = (1 + P)⁻¹ times the computed inverse.
    const Matrix H = sizes(H_) + rounded;
    const Eigen::VectorXd row = P.rowwise().sum() * (off / (1 - off));
    const Eigen::RowVectorXd column = H.colwise().maxCoeff();
    Matrix error = (rounded + P * H + row * column) * upward;
    balance_blocks(error);
    E_.resize(blocks(), blocks());
    centre_.resize(at(blocks())), powers_.resize(at(blocks()));
    for (Index j = 0; j < blocks(); ++j) {
      for (Index i = 0; i < blocks(); ++i) {
        Matrix part = error.block(first(i), first(j), size(i), size(j));
        if (i != j) part += sizes(H_.block(first(i), first(j), size(i), size(j)));
        E_(i, j) = part.norm() * upward;
      }
      LongComplexMatrix D = block(j);
      centre_[at(j)] = D.trace() / static_cast<long double>(size(j));
      D.diagonal().array() -= centre_[at(j)];
      if (size(j) == 1) D.setZero();
      powers_[at(j)] = power_norms(D);
    }
    return E_.allFinite() || join_closest();
  }
  // Powers of two inside each block for which what is certain and what is not are of like size: of a Jordan block with
  // ε in the corner all entries become ε^(1/k), and norms say no more than they must.
  void balance_blocks(Matrix& error) {
    block_scale_ = Eigen::VectorXd::Ones(n_);
    for (Index j = 0; j < blocks(); ++j) {
      const Index begin = first(j), k = size(j);
      if (k == 1) continue;
      const std::vector<int> power = balancing_powers(sizes(block(j)) + error.block(begin, begin, k, k));
      for (Index a = 0; a < k; ++a) block_scale_(begin + a) = std::ldexp(1.0, power[at(a)]);
    }
    const Eigen::VectorXd reciprocal = block_scale_.cwiseInverse();
    error = reciprocal.asDiagonal() * error * block_scale_.asDiagonal();
    for (Index a = 0; a < n_; ++a) {
      H_.col(a) *= static_cast<long double>(block_scale_(a));
      H_.row(a) *= static_cast<long double>(reciprocal(a));
    }
  }
  LongComplexMatrix block(Index j) const { return H_.block(first(j), first(j), size(j), size(j)); }

  double distance(Index i, Index j) const { return static_cast<double>(std::abs(centre_[at(i)] - centre_[at(j)])); }
  // σ_min(z − D_j) for z within `radius` of the centre of i.
  double separation(Index i, Index j, double radius) const {
    const double left = distance(i, j) / upward - radius;
    if (size(j) == 1) return left;
    return std::max(1 / resolvent_bound(powers_[at(j)], left), left - powers_[at(j)][1]);
  }

  // Nothing where a block is too close, or the weights grow without limit: `joined` then names whom to take in.
  std::optional<double> tau(Index i, double radius, Index& joined) const {
    const Index q = blocks();
    Eigen::VectorXd apart(q);
    for (Index j = 0; j < q; ++j) {
      apart(j) = j == i ? infinity : separation(i, j, radius);
      if (!(apart(j) > 0) && (joined == i || distance(i, j) < distance(i, joined))) joined = j;
    }
    if (joined != i) return std::nullopt;
    // One step and a geometric sum, parts measured against the largest entry of their column, are mostly enough.
    const Eigen::VectorXd from = E_.col(i).cwiseQuotient(apart), feed = row_.cwiseQuotient(apart);
    const double growth = column_.cwiseProduct(feed).maxCoeff();
    const double second = E_.row(i).dot(from);
    const double rest = E_.row(i).dot(feed) * column_.cwiseProduct(from).maxCoeff() / (1 - growth);
    if (growth <= 0.5 && rest <= 0.1 * (E_(i, i) + second)) return (E_(i, i) + second + rest) * upward;

    const Eigen::VectorXd start = (E_.col(i).array() + least_size) / apart.array();
    Eigen::VectorXd w = start * 1.001, next(q);
    w(i) = 0;
    for (int round = 0; round < most_rounds_of_weights; ++round) {
      next = start + (E_ * w).cwiseQuotient(apart);
      next(i) = 0;
      next *= upward;
      if ((next.array() <= w.array()).all()) return (E_(i, i) + E_.row(i).dot(w)) * upward;
      w = w.cwiseMax(next * 1.001);
      if (!w.allFinite() || w.maxCoeff() > 1e250) break;
    }
    joined = i == 0 ? 1 : 0;
    double most = -1;
    for (Index j = 0; j < q; ++j) {
      // Units of blocks are arbitrary, so that only both couplings together say how close two are: one of them alone
      // may be large where nothing is. A block that is not known to within its distance is as good as here, coupled or
      // not.
      const double both = std::sqrt(E_(i, j)) * std::sqrt(E_(j, i));
      const double coupling = j == i ? -1 : std::max(both, E_(j, j)) / apart(j);
      if (coupling > most) most = coupling, joined = j;
    }
    return std::nullopt;
  }

  bool include() {
    const Index q = blocks();
    radius_.assign(at(blocks()), infinity), tau_ = radius_;
    column_ = E_.colwise().maxCoeff().transpose().cwiseMax(least_size);
    row_ = E_ * column_.cwiseInverse();
    std::vector<std::pair<Index, Index>> wanted;
    for (Index i = 0; i < q; ++i) {
      double assumed = 0;
      Index joined = i;
      for (int round = 0; round < 60; ++round) {
        const std::optional<double> t = tau(i, assumed, joined);
        if (!t) break;
        const double r = smallest_radius(powers_[at(i)], *t);
        if (!std::isfinite(r)) break;
        if (r <= assumed) {
          radius_[at(i)] = r, tau_[at(i)] = *t;
          break;
        }
        assumed = 1.5 * r;
      }
      if (!std::isfinite(radius_[at(i)])) wanted.emplace_back(i, joined == i ? nearest(i) : joined);
    }
    if (!wanted.empty()) return join_nearest(wanted);
    bool all = true;
    for (Index i = 0; i < q; ++i) {
      for (Index j = 0; j < i; ++j) {
        if (!touch(centre_[at(i)], centre_[at(j)], radius_[at(i)] + radius_[at(j)])) continue;
        all = false;
        join(i, j);
      }
    }
    return all;
  }
  static bool touch(LongComplex a, LongComplex b, double radii) {
    return static_cast<double>(std::abs(a - b)) <= radii * upward;
  }

  // Two that are nearly one direction leave all others without a bound: once they are together the others are seen
  // again.
  bool join_nearest(const std::vector<std::pair<Index, Index>>& wanted) {
    constexpr double as_near = 1e3;
    double least = infinity;
    for (const auto& [i, j] : wanted) least = std::min(least, distance(i, j));
    for (const auto& [i, j] : wanted) {
      if (distance(i, j) <= as_near * least) join(i, j);
    }
    return false;
  }

  // Whom a disc's mirror image meets: itself, or one other.
  bool mirrored() {
    if (!real_) return true;
    mirror_.assign(at(blocks()), -1);
    bool all = true;
    for (Index i = 0; i < blocks(); ++i) {
      for (Index j = 0; j < blocks(); ++j) {
        if (!touch(std::conj(centre_[at(i)]), centre_[at(j)], radius_[at(i)] + radius_[at(j)])) continue;
        if (mirror_[at(i)] >= 0) {
          join(mirror_[at(i)], j);
          all = false;
        }
        mirror_[at(i)] = j;
      }
    }
    for (Index i = 0; all && i < blocks(); ++i) {
      const Index j = mirror_[at(i)];
      if (j >= 0 && size(j) == size(i)) continue;
      join(i, j >= 0 && j != i ? j : nearest(i));
      all = false;
    }
    return all;
  }

  Index root(Index i) const {
    while (join_[at(i)] != i) i = join_[at(i)];
    return i;
  }
  void join(Index i, Index j) {
    const Index a = root(i), b = root(j);
    join_[at(std::max(a, b))] = std::min(a, b);
  }
  Index nearest(Index i) const {
    Index best = i;
    for (Index j = 0; j < blocks(); ++j) {
      if (j != i &&
          (best == i || std::abs(schur_.mean(j) - schur_.mean(i)) < std::abs(schur_.mean(best) - schur_.mean(i))))
        best = j;
    }
    return best;
  }
  bool join_equal() {
    const LongComplexMatrix& T = schur_.triangle();
    const long double least = 4 * static_cast<long double>(long_eps) * T.norm();
    const auto before = join_;
    for (Index a = 0; a < n_; ++a) {
      for (Index b = 0; b < a; ++b) {
        if (std::abs(T(a, a) - T(b, b)) <= least) join(schur_.cluster_of(a), schur_.cluster_of(b));
      }
    }
    return join_ == before ? join_closest() : false;
  }
  bool join_closest() {
    double least = infinity;
    Index a = 0, b = 0;
    for (Index i = 0; i < blocks(); ++i) {
      for (Index j = 0; j < i; ++j) {
        const auto d = static_cast<double>(std::abs(schur_.mean(i) - schur_.mean(j)));
        if (d < least) least = d, a = i, b = j;
      }
    }
    join(a, b);
    return false;
  }
  // Those that the inverse finds nearly in the span of the others, each with its neighbour.
  bool join_oblique(const Matrix& inverse) {
    const Eigen::VectorXd size_of_row = inverse.rowwise().norm();
    const double most = size_of_row.maxCoeff();
    if (!std::isfinite(most)) return join_closest();
    for (Index k = 0; k < n_; ++k) {
      if (size_of_row(k) >= 0.1 * most) join(schur_.cluster_of(k), nearest(schur_.cluster_of(k)));
    }
    return false;
  }
  bool merge() {
    std::vector<Index> joined;
    for (Index i = 0; i < blocks(); ++i) joined.push_back(root(i));
    const Index before = blocks();
    schur_.join(joined);
    return blocks() < before;
  }

  std::vector<InclusionDisc> discs() const {
    std::vector<InclusionDisc> out;
    for (Index i = 0; i < blocks(); ++i) {
      LongComplex c = centre_[at(i)];
      double radius = radius_[at(i)];
      const bool on_axis = real_ && mirror_[at(i)] == i;
      if (on_axis) {
        radius += static_cast<double>(std::abs(c.imag()));
        c.imag(0);
      } else if (real_ && c.imag() < 0) {
        continue;
      }
      InclusionDisc disc;
      disc.centre = Complex(static_cast<double>(c.real()), static_cast<double>(c.imag()));
      disc.radius = (radius + static_cast<double>(std::abs(c - LongComplex(disc.centre)))) * upward;
      disc.count = size(i), disc.tau = tau_[at(i)];
      disc.powers = powers_[at(i)];
      disc.basis = Z_.middleCols(first(i), size(i)).cast<Complex>();
      disc.dual = inverse_.middleRows(first(i), size(i)).adjoint().cast<Complex>();
      add_vectors(M_, scale_, on_axis, disc);
      const Eigen::VectorXd inside = block_scale_.segment(first(i), size(i));
      disc.basis = scale_.asDiagonal() * disc.basis * inside.asDiagonal();
      disc.dual = scale_.cwiseInverse().asDiagonal() * disc.dual * inside.cwiseInverse().asDiagonal();
      out.push_back(std::move(disc));
    }
    return out;
  }

  const Index n_;
  const bool real_;
  LongComplexMatrix M_, Z_, inverse_, H_;
  ClusteredSchur schur_;
  Matrix U_, E_;
  Eigen::VectorXd scale_, block_scale_, column_, row_;
  std::vector<Index> join_, mirror_;
  std::vector<LongComplex> centre_;
  std::vector<std::vector<double>> powers_;
  std::vector<double> radius_, tau_;
};

}  // namespace

double InclusionDisc::radius_under(double change) const { return smallest_radius(powers, change); }

std::optional<std::vector<InclusionDisc>> inclusion_discs(const LongComplexMatrix& M, const Matrix& uncertainty,
                                                          bool real) {
  return Inclusion(M, uncertainty, real).run();
}

}  // namespace dynalin

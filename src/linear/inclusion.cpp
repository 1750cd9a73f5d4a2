#include "linear/inclusion.h"

#include <lapacke.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "linear/pencil_residual.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;
using Complex = std::complex<double>;
using LongComplex = std::complex<long double>;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;
using LongReal = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double upward = 1 + 1e-9;           // covers the rounding of bounds that are themselves sums in double
constexpr double least_size = 1e-300;         // keeps strict inequalities strict
constexpr double most_inverse_defect = 0.05;  // of a basis times its computed inverse
constexpr int most_rounds_of_weights = 300;
constexpr Index most_in_long_double = 60;  // for the QR iteration

std::size_t at(Index k) { return static_cast<std::size_t>(k); }

// Products of complex matrices by their parts: the operators of std::complex ask for infinities at every step.
LongComplexMatrix times(const LongComplexMatrix& a, const LongComplexMatrix& b) {
  const LongReal ar = a.real(), ai = a.imag(), br = b.real(), bi = b.imag();
  LongComplexMatrix c(a.rows(), b.cols());
  c.real() = ar * br - ai * bi;
  c.imag() = ar * bi + ai * br;
  return c;
}
Matrix sizes(const LongComplexMatrix& m) {
  return m.unaryExpr([](const LongComplex& v) { return static_cast<double>(std::abs(v)); });
}
// Of a sum of products of complex numbers, n of them, in units of Σ|a||b|.
double rounding_of_sum(Index n) { return 2 * static_cast<double>(n + 4) * long_eps; }

// Bounds of |N^l| in the Frobenius norm, l = 0 … k; that of the first is the 2-norm.
std::vector<double> power_norms(const LongComplexMatrix& N) {
  const Index k = N.rows();
  std::vector<double> out{1.0};
  const double norm = sizes(N).norm() * upward;
  LongComplexMatrix power = N;
  double error = 0, before = norm;
  for (Index l = 1; l <= k; ++l) {
    if (l > 1) {
      power = times(power, N);
      error = norm * (error + rounding_of_sum(k) * before);
    }
    before = (sizes(power).norm() + error) * upward;
    out.push_back(before);
  }
  return out;
}

// A bound of |(ζ − N)⁻¹| by Σ_l |N^l|/|ζ|^(l+1) / (1 − |N^k|/|ζ|^k).
double resolvent_bound(const std::vector<double>& powers, double distance) {
  if (!(distance > 0)) return infinity;
  const std::size_t k = powers.size() - 1;
  double sum = 0, scale = 1 / distance;
  for (std::size_t l = 0; l < k; ++l, scale /= distance) sum += powers[l] * scale;
  const double rest = 1 - powers[k] * scale * distance;
  return rest > 0 && std::isfinite(sum) ? sum / rest * upward : infinity;
}

// The smallest circle around the centre of a block on which |(z − D)⁻¹| tau < 1.
double smallest_radius(const std::vector<double>& powers, double tau) {
  if (!std::isfinite(tau)) return infinity;
  const double need = std::max(tau, least_size) * upward;
  double high = need;
  while (resolvent_bound(powers, high) * need >= 1) {
    high *= 2;
    if (!std::isfinite(high)) return infinity;
  }
  double low = high / 2;
  for (int k = 0; k < 12; ++k) {
    const double middle = std::sqrt(low * high);
    (resolvent_bound(powers, middle) * need < 1 ? high : low) = middle;
  }
  return high;
}

class Inclusion {
 public:
  Inclusion(const LongComplexMatrix& M, const Matrix& uncertainty, bool real)
      : n_(M.rows()), real_(real), M_(M), U_(uncertainty), scale_(Eigen::VectorXd::Ones(n_)) {}

  std::optional<std::vector<InclusionDisc>> run() {
    balance();
    if (!schur()) return std::nullopt;
    label_.resize(at(n_));
    std::iota(label_.begin(), label_.end(), Index{0});
    for (;;) {
      arrange();
      join_.resize(first_.size());
      std::iota(join_.begin(), join_.end(), Index{0});
      if (measure() && include() && mirrored()) break;
      if (!merge()) return std::nullopt;
    }
    return discs();
  }

 private:
  Index blocks() const { return static_cast<Index>(first_.size()); }
  Index size(Index i) const { return (i + 1 < blocks() ? first_[at(i + 1)] : n_) - first_[at(i)]; }

  // Whatever is missing from the Schur form is found again in E.
  bool schur() {
    if (n_ <= most_in_long_double) {
      const Eigen::ComplexSchur<LongComplexMatrix> found(M_);
      if (found.info() != Eigen::Success) return false;
      T_ = found.matrixT(), Q_ = found.matrixU();
      return true;
    }
    ComplexMatrix T = M_.cast<Complex>(), Q(n_, n_);
    Eigen::VectorXcd values(n_);
    const auto n = static_cast<lapack_int>(n_);
    const auto lapack = [](ComplexMatrix& m) { return reinterpret_cast<lapack_complex_double*>(m.data()); };
    lapack_int unused = 0;
    if (LAPACKE_zgees(LAPACK_COL_MAJOR, 'V', 'N', nullptr, n, lapack(T), n, &unused,
                      reinterpret_cast<lapack_complex_double*>(values.data()), lapack(Q), n) != 0)
      return false;
    T_ = T.cast<LongComplex>(), Q_ = Q.cast<LongComplex>();
    return true;
  }

  // By powers of two: exact.
  void balance() {
    for (bool changed = true; changed;) {
      changed = false;
      for (Index i = 0; i < n_; ++i) {
        long double row = 0, column = 0;
        for (Index j = 0; j < n_; ++j) {
          if (j == i) continue;
          row += std::abs(M_(i, j)), column += std::abs(M_(j, i));
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

  // Exchanges the neighbours k and k + 1 on the diagonal of T by a rotation.
  void exchange(Index k) {
    const LongComplex a = T_(k, k), b = T_(k + 1, k + 1), x = T_(k, k + 1), y = b - a;
    const long double norm = std::hypot(std::abs(x), std::abs(y));
    if (norm > 0) {
      const LongComplex c = x / norm, s = y / norm;  // (c, s) spans the eigenvector of b
      const auto turn = [&](auto&& left, auto&& right) {
        for (Index r = 0; r < left.size(); ++r) {
          const LongComplex p = left(r), q = right(r);
          left(r) = p * c + q * s;
          right(r) = q * std::conj(c) - p * std::conj(s);
        }
      };
      turn(T_.col(k).head(k + 2), T_.col(k + 1).head(k + 2));
      turn(Q_.col(k), Q_.col(k + 1));
      for (Index j = k; j < n_; ++j) {
        const LongComplex p = T_(k, j), q = T_(k + 1, j);
        T_(k, j) = std::conj(c) * p + std::conj(s) * q;
        T_(k + 1, j) = c * q - s * p;
      }
      T_(k + 1, k) = 0;
      T_(k, k) = b, T_(k + 1, k + 1) = a;
    }
    std::swap(label_[at(k)], label_[at(k + 1)]);
  }

  // Clusters stand together on the diagonal.
  void arrange() {
    first_.clear();
    for (Index begin = 0; begin < n_;) {
      first_.push_back(begin);
      const Index label = label_[at(begin)];
      Index end = begin + 1;
      for (Index k = end; k < n_; ++k) {
        if (label_[at(k)] != label) continue;
        for (Index m = k; m > end; --m) exchange(m - 1);
        ++end;
      }
      begin = end;
    }
  }

  // Bases of the invariant subspaces, orthonormal each: T V = V diag(T_jj), V_jj = 1.
  LongComplexMatrix basis() const {
    LongComplexMatrix Z(n_, n_);
    for (Index j = 0; j < blocks(); ++j) {
      const Index begin = first_[at(j)], k = size(j);
      LongComplexMatrix v = LongComplexMatrix::Zero(begin + k, k);
      v.bottomRows(k).setIdentity();
      for (Index c = 0; c < k; ++c) {
        LongComplexMatrix right = -T_.block(0, begin + c, begin, 1);
        for (Index b = 0; b < c; ++b) right += v.col(b).head(begin) * T_(begin + b, begin + c);
        for (Index r = begin - 1; r >= 0; --r) {
          const LongComplex x = right(r, 0) / (T_(r, r) - T_(begin + c, begin + c));
          v(r, c) = x;
          right.col(0).head(r) -= T_.col(r).head(r) * x;
        }
      }
      LongComplexMatrix z = times(Q_.leftCols(begin + k), v);
      if (k == 1) {
        z /= z.norm();
      } else {
        z = Eigen::HouseholderQR<LongComplexMatrix>(z).householderQ() * LongComplexMatrix::Identity(n_, k);
      }
      Z.middleCols(begin, k) = z;
    }
    return Z;
  }

  bool measure() {
    Z_ = basis();
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
    centre_.resize(first_.size()), powers_.resize(first_.size());
    for (Index j = 0; j < blocks(); ++j) {
      for (Index i = 0; i < blocks(); ++i) {
        Matrix part = error.block(first_[at(i)], first_[at(j)], size(i), size(j));
        if (i != j) part += sizes(H_.block(first_[at(i)], first_[at(j)], size(i), size(j)));
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
      const Index begin = first_[at(j)], k = size(j);
      if (k == 1) continue;
      Matrix B = sizes(block(j)) + error.block(begin, begin, k, k);
      B.diagonal().setZero();
      for (int round = 0; round < 100; ++round) {
        bool changed = false;
        for (Index a = 0; a < k; ++a) {
          const double of_row = B.row(a).norm(), of_column = B.col(a).norm();
          if (!(of_row > 0 && of_column > 0)) continue;
          const int exponent = static_cast<int>(std::lround(std::log2(of_row / of_column) / 2));
          if (exponent == 0) continue;
          const double f = std::ldexp(1.0, exponent);
          B.col(a) *= f, B.row(a) /= f;
          block_scale_(begin + a) *= f;
          changed = true;
        }
        if (!changed) break;
      }
    }
    const Eigen::VectorXd reciprocal = block_scale_.cwiseInverse();
    error = reciprocal.asDiagonal() * error * block_scale_.asDiagonal();
    for (Index a = 0; a < n_; ++a) {
      H_.col(a) *= static_cast<long double>(block_scale_(a));
      H_.row(a) *= static_cast<long double>(reciprocal(a));
    }
  }
  LongComplexMatrix block(Index j) const { return H_.block(first_[at(j)], first_[at(j)], size(j), size(j)); }

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
      const double coupling = j == i ? -1 : std::max(E_(i, j), E_(j, i)) / apart(j);
      if (coupling > most) most = coupling, joined = j;
    }
    return std::nullopt;
  }

  bool include() {
    const Index q = blocks();
    radius_.assign(first_.size(), infinity), tau_ = radius_;
    column_ = E_.colwise().maxCoeff().transpose().cwiseMax(least_size);
    row_ = E_ * column_.cwiseInverse();
    bool all = true;
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
      if (std::isfinite(radius_[at(i)])) continue;
      all = false;
      if (joined == i) joined = nearest(i);
      join(i, joined);
    }
    if (!all) return false;
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

  // Whom a disc's mirror image meets: itself, or one other.
  bool mirrored() {
    if (!real_) return true;
    mirror_.assign(first_.size(), -1);
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
      if (j != i && (best == i || std::abs(centre_of(j) - centre_of(i)) < std::abs(centre_of(best) - centre_of(i))))
        best = j;
    }
    return best;
  }
  LongComplex centre_of(Index j) const { return T_.diagonal().segment(first_[at(j)], size(j)).mean(); }
  bool join_equal() {
    const long double least = 4 * static_cast<long double>(long_eps) * T_.norm();
    const auto before = join_;
    for (Index a = 0; a < n_; ++a) {
      for (Index b = 0; b < a; ++b) {
        if (std::abs(T_(a, a) - T_(b, b)) <= least) join(owner(a), owner(b));
      }
    }
    return join_ == before ? join_closest() : false;
  }
  Index owner(Index k) const { return std::upper_bound(first_.begin(), first_.end(), k) - first_.begin() - 1; }
  bool join_closest() {
    double least = infinity;
    Index a = 0, b = 0;
    for (Index i = 0; i < blocks(); ++i) {
      for (Index j = 0; j < i; ++j) {
        const auto d = static_cast<double>(std::abs(centre_of(i) - centre_of(j)));
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
      if (size_of_row(k) >= 0.1 * most) join(owner(k), nearest(owner(k)));
    }
    return false;
  }
  bool merge() {
    const Index before = blocks();
    for (Index k = 0; k < n_; ++k) label_[at(k)] = root(owner(k));
    Index left = 0;
    for (Index i = 0; i < before; ++i) left += root(i) == i;
    return left < before;
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
      disc.basis = Z_.middleCols(first_[at(i)], size(i)).cast<Complex>();
      disc.dual = inverse_.middleRows(first_[at(i)], size(i)).adjoint().cast<Complex>();
      add_vectors(i, on_axis, disc);
      const Eigen::VectorXd inside = block_scale_.segment(first_[at(i)], size(i));
      disc.basis = scale_.asDiagonal() * disc.basis * inside.asDiagonal();
      disc.dual = scale_.cwiseInverse().asDiagonal() * disc.dual * inside.cwiseInverse().asDiagonal();
      out.push_back(std::move(disc));
    }
    return out;
  }

  // Vectors that D − c shrinks most, to the right and to the left.
  void add_vectors(Index i, bool on_axis, InclusionDisc& disc) const {
    const Index k = size(i);
    ComplexMatrix X = disc.basis, Y = disc.dual;
    if (on_axis && k > 1) {  // a real basis of a subspace that is its own conjugate
      const auto real_basis = [&](const ComplexMatrix& m) -> Matrix {
        Matrix both(n_, 2 * k);
        both << m.real(), m.imag();
        return Eigen::ColPivHouseholderQR<Matrix>(both).householderQ() * Matrix::Identity(n_, k);
      };
      const Matrix x = real_basis(X), y = real_basis(Y);
      X = x.cast<Complex>();
      Y = (y * (x.transpose() * y).inverse()).cast<Complex>();
    }
    ComplexMatrix v = ComplexMatrix::Ones(1, 1), u = v;
    if (k > 1) {
      const LongComplexMatrix MX = times(M_, X.cast<LongComplex>());
      LongComplexMatrix D = times(Y.adjoint().cast<LongComplex>(), MX);
      D.diagonal().array() -= LongComplex(disc.centre);
      const Eigen::JacobiSVD<ComplexMatrix> svd(D.cast<Complex>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
      v = svd.matrixV().rowwise().reverse(), u = svd.matrixU().rowwise().reverse();
      const Eigen::VectorXd s = svd.singularValues().reverse();
      const double small = 1e-10 * s(k - 1) + 10 * s(0);
      for (Index a = 1; a < k; ++a) {
        if (s(a) > small) v.col(a) = v.col(0), u.col(a) = u.col(0);
      }
    }
    disc.right = scale_.asDiagonal() * ComplexMatrix(X * v);
    disc.left = scale_.cwiseInverse().asDiagonal() * ComplexMatrix(Y * u);
    if (on_axis) {
      const auto make_real = [](ComplexMatrix& m) {
        for (Index a = 0; a < m.cols(); ++a) {
          Index row = 0;
          m.col(a).cwiseAbs().maxCoeff(&row);
          const Complex phase = m(row, a) / std::abs(m(row, a));
          m.col(a) /= phase;
          m.col(a).imag().setZero();
        }
      };
      make_real(disc.right), make_real(disc.left);
    }
    disc.right.colwise().normalize();
    disc.left.colwise().normalize();
  }

  const Index n_;
  const bool real_;
  LongComplexMatrix M_, T_, Q_, Z_, inverse_, H_;
  Matrix U_, E_;
  Eigen::VectorXd scale_, block_scale_, column_, row_;
  std::vector<Index> label_, first_, join_, mirror_;
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

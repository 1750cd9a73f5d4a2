#include "linear/eigen_refinement.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "system/shifted_lu.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using LongComplex = std::complex<long double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;
using ComplexVector = Eigen::VectorXcd;
using LongMatrix = Eigen::Matrix<LongComplex, Eigen::Dynamic, Eigen::Dynamic>;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double long_eps = 5.5e-20;  // rounding of one operation in long double

// At most so many eigenvalues are refined by inverse iteration, smallest first, and only where the factors are small.
constexpr std::size_t most_refined = 100;
constexpr double most_factor_entries = 2e7;
constexpr double least_product = 1e-12;  // |yᴴ x| of unit vectors
constexpr double good_enough = 1e-13;    // bound against modulus

// What the sparse equations say about a pair: the residual (S − λ E) w and what the sums of its rows may have rounded.
struct Residual {
  ComplexVector value;
  Eigen::VectorXd rounding;
};
Residual residual(const ColumnMatrix& S, std::int32_t states, LongComplex lambda, const ComplexVector& w) {
  const auto n = static_cast<std::size_t>(S.rows);
  std::vector<LongComplex> sum(n);
  Residual r;
  r.rounding = Eigen::VectorXd::Zero(S.rows);
  Eigen::VectorXd terms = Eigen::VectorXd::Constant(S.rows, 2);
  for (std::int32_t c = 0; c < S.columns; ++c) {
    const LongComplex x(w(c));
    const double magnitude = std::abs(w(c).real()) + std::abs(w(c).imag());
    if (magnitude == 0) continue;
    for (auto k = static_cast<std::size_t>(S.start[static_cast<std::size_t>(c)]);
         k < static_cast<std::size_t>(S.start[static_cast<std::size_t>(c) + 1]); ++k) {
      sum[static_cast<std::size_t>(S.row[k])] += static_cast<long double>(S.value[k]) * x;
      r.rounding(S.row[k]) += std::abs(S.value[k]) * magnitude;
      ++terms(S.row[k]);
    }
  }
  const auto modulus = static_cast<double>(std::abs(lambda));
  for (std::int32_t c = S.columns - states; c < S.columns; ++c) {
    const LongComplex x(w(c));
    LongComplex& s = sum[static_cast<std::size_t>(c)];
    s -= lambda * x;
    r.rounding(c) += 2 * modulus * std::abs(w(c));
  }
  r.rounding.array() *= long_eps * terms.array();
  r.value.resize(S.rows);
  for (std::size_t k = 0; k < n; ++k) {
    r.value(static_cast<Index>(k)) = Complex(static_cast<double>(sum[k].real()), static_cast<double>(sum[k].imag()));
  }
  return r;
}

template <class Function>
ComplexMatrix by_parts(const ComplexMatrix& m, Function&& real_map) {
  Matrix both(m.rows(), 2 * m.cols());
  both << m.real(), m.imag();
  const Matrix image = real_map(both);
  ComplexMatrix out(image.rows(), m.cols());
  out.real() = image.leftCols(m.cols());
  out.imag() = image.rightCols(m.cols());
  return out;
}

class Refiner {
 public:
  Refiner(const PerturbationEquations& equations, const ZeroModes& zero, EigenPairs& pairs)
      : equations_(equations), zero_(zero), pairs_(pairs), count_(pairs.right.cols()), trust_(pairs.values.size()) {}

  std::vector<EigenTrust> run() {
    // The second pass starts from vectors that are good to second order.
    for (int pass = 0; pass < 2; ++pass) {
      measure();
      find_clusters();
      if (pass == 0) improve_vectors();
      correct();
      if (settled()) break;
    }
    invert();
    doubt_rounding();
    return std::move(trust_);
  }

 private:
  // Member i of the table, or the conjugate that belongs to it.
  struct Member {
    Index at;
    bool conjugate;
  };
  bool real(Index i) const { return pairs_.values[static_cast<std::size_t>(i)].imag() == 0; }
  Complex value(const Member& m) const {
    const Complex v = pairs_.values[static_cast<std::size_t>(m.at)];
    return m.conjugate ? std::conj(v) : v;
  }

  // Residuals, their components along all modes, and what rounding leaves in them.
  void measure() {
    const Index n = equations_.states(), N = equations_.unknowns();
    ComplexMatrix reduced(n, count_);
    floor_ = Eigen::VectorXd::Zero(count_);
    constexpr Index block = 64;
    for (Index first = 0; first < count_; first += block) {
      const Index columns = std::min(block, count_ - first);
      const ComplexMatrix x = pairs_.right.middleCols(first, columns), y = pairs_.left.middleCols(first, columns);
      const ComplexMatrix a = by_parts(x, [&](const Matrix& m) { return equations_.complete(m); });
      const ComplexMatrix b = by_parts(y, [&](const Matrix& m) { return equations_.complete_left(m); });
      ComplexMatrix r(N, columns);
      for (Index c = 0; c < columns; ++c) {
        ComplexVector w(N);
        w << a.col(c), x.col(c);
        const Residual of =
            residual(equations_.pencil(), equations_.states(), pairs_.values[static_cast<std::size_t>(first + c)], w);
        r.col(c) = of.value;
        floor_(first + c) =
            b.col(c).cwiseAbs().dot(of.rounding.head(b.rows())) + y.col(c).cwiseAbs().dot(of.rounding.tail(n));
      }
      reduced.middleCols(first, columns) = by_parts(r, [&](const Matrix& m) { return equations_.reduced(m); });
    }
    along_ = pairs_.left.adjoint() * reduced;
    along_conjugate_ = pairs_.left.transpose() * reduced;
    product_ = pairs_.left.adjoint() * pairs_.right;
    product_conjugate_ = pairs_.left.transpose() * pairs_.right;
    find_defective();
    measure_zero_modes(reduced);
    for (Index i = 0; i < count_; ++i) {
      // The components are sums in double of residuals that are themselves rounding.
      floor_(i) += 1e-8 * pairs_.left.col(i).cwiseAbs().dot(reduced.col(i).cwiseAbs());
      floor_(i) /= defective(i) ? 1 : std::abs(product_(i, i));
    }
  }

  // Left and right vectors of a defective eigenvalue are orthogonal: nothing can be measured along them. What a change
  // of A by its rounding does is bounded by Elsner's theorem for the eigenvalues that come together there.
  void find_defective() {
    defective_bound_ = Eigen::VectorXd::Zero(count_);
    const double size = zero_.block.norm(), change = 16 * eps * size;
    for (Index i = 0; i < count_; ++i) {
      if (std::abs(product_(i, i)) > least_product) continue;
      int together = 0;
      for (Index j = 0; j < count_; ++j) {
        if (std::abs(product_(j, j)) > least_product) continue;
        if (std::abs(value({i, false}) - value({j, false})) <= 1e-3 * size) ++together;
        if (!real(j) && std::abs(value({i, false}) - value({j, true})) <= 1e-3 * size) ++together;
      }
      const double k = std::max(together, 2);
      defective_bound_(i) = std::pow(2 * size, 1 - 1 / k) * std::pow(change, 1 / k);
    }
  }
  bool defective(Index i) const { return defective_bound_(i) > 0; }

  // What the equations say about the zeros that were split off couples them with the others as well:
  // g_i0 (λ_i − N)⁻¹ g_0i.
  void measure_zero_modes(const ComplexMatrix& reduced) {
    zero_coupling_ = Eigen::VectorXd::Zero(count_);
    zero_share_ = ComplexMatrix::Zero(equations_.states(), count_);
    const Index z = zero_.count, n = equations_.states(), N = equations_.unknowns();
    if (z == 0 || count_ == 0) return;
    const Matrix T0 = zero_.right().leftCols(z), chains = zero_.block.topLeftCorner(z, z);
    const Matrix a = equations_.complete(T0);
    Matrix r(N, z);
    for (Index c = 0; c < z; ++c) {
      ComplexVector w(N);
      w << a.col(c).cast<Complex>(), T0.col(c).cast<Complex>();
      r.col(c) = residual(equations_.pencil(), equations_.states(), 0, w).value.real();
    }
    r.bottomRows(n) -= T0 * chains;
    const ComplexMatrix from_zero = pairs_.left.adjoint() * equations_.reduced(r).cast<Complex>();
    // Dual to the zero modes: the upper rows of T⁻¹ less what belongs to the other modes.
    const ComplexMatrix dual = zero_.left().leftCols(z).transpose().cast<Complex>();
    const ComplexMatrix U = dual * pairs_.right, onto = dual * reduced;
    for (Index i = 0; i < count_; ++i) {
      if (defective(i)) continue;
      ComplexVector to_zero = onto.col(i);
      for (Index j = 0; j < count_; ++j) {
        if (defective(j)) continue;
        to_zero -= U.col(j) * g({j, false}, {i, false});
        if (!real(j)) to_zero -= U.col(j).conjugate() * g({j, true}, {i, false});
      }
      const Complex lambda = value({i, false});
      ComplexMatrix shifted = -chains.cast<Complex>();
      shifted.diagonal().array() += lambda;
      const ComplexVector through = shifted.triangularView<Eigen::Upper>().solve(to_zero);
      zero_share_.col(i) = T0 * through;
      zero_coupling_(i) = from_zero.row(i).cwiseAbs().dot(through.cwiseAbs()) / std::abs(product_(i, i));
    }
  }

  // Entries of (Yᴴ R) and (Yᴴ X) among members, in units of y_iᴴ x_i.
  Complex component(const ComplexMatrix& plain, const ComplexMatrix& crossed, const Member& i, const Member& j) const {
    const bool across = i.conjugate != j.conjugate;
    Complex v = (across ? crossed : plain)(i.at, j.at);
    // (y̅_i)ᴴ r_j = y_iᵀ r_j and its conjugate y_iᴴ r̅_j.
    if (j.conjugate) v = std::conj(v);
    const Complex unit = product_(i.at, i.at);
    return v / (i.conjugate ? std::conj(unit) : unit);
  }
  Complex g(const Member& i, const Member& j) const { return component(along_, along_conjugate_, i, j); }
  Complex p(const Member& i, const Member& j) const { return component(product_, product_conjugate_, i, j); }

  template <class Function>
  void for_others(Index i, Function&& visit) const {
    for (Index j = 0; j < count_; ++j) {
      if (defective(j)) continue;
      if (j != i) visit(Member{j, false});
      if (!real(j)) visit(Member{j, true});
    }
  }

  // Eigenvalues that perturbations of the size of the residuals mix belong together, and equal ones always.
  void find_clusters() {
    group_.resize(static_cast<std::size_t>(count_));
    std::iota(group_.begin(), group_.end(), Index{0});
    closed_.assign(static_cast<std::size_t>(count_), false);
    for (Index i = 0; i < count_; ++i) {
      if (defective(i)) continue;
      const Member me{i, false};
      for_others(i, [&](const Member& j) {
        const double gap = std::abs(value(me) - value(j));
        const double mixing = std::sqrt(std::abs(g(me, j)) * std::abs(g(j, me)));
        if (gap > 0 && mixing <= gap / 8 && std::abs(p(me, j)) * std::abs(p(j, me)) <= 1e-4) return;
        const Index a = root(i), b = root(j.at);
        group_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
        if (j.conjugate) closed_[static_cast<std::size_t>(std::min(a, b))] = true;
      });
    }
    for (Index i = 0; i < count_; ++i) {
      const Index r = root(i);
      if (closed_[static_cast<std::size_t>(i)]) closed_[static_cast<std::size_t>(r)] = true;
    }
  }
  Index root(Index i) const {
    while (group_[static_cast<std::size_t>(i)] != i) i = group_[static_cast<std::size_t>(i)];
    return i;
  }

  // What a cluster becomes; a pair of real ones may turn out to be complex and the other way round.
  struct Corrected {
    std::vector<Complex> values;
    ComplexMatrix right, left;
    double bound = 0;
  };

  // Each vector takes the first-order share of those outside its cluster:
  // x_i + Σ_j x_j G_ji/(λ_i − λ_j) and, dual to it, y_i − Σ_j y_j (p_ij + G_ij/(λ_j − λ_i))ᴴ.
  void improve_vectors() {
    ComplexMatrix right = ComplexMatrix::Zero(count_, count_), right_conjugate = right, left = right,
                  left_conjugate = right;
    for (Index i = 0; i < count_; ++i) {
      if (defective(i)) continue;
      const Member me{i, false};
      for_others(i, [&](const Member& j) {
        if (root(j.at) == root(i) && (closed_[static_cast<std::size_t>(root(i))] || !j.conjugate)) return;
        const Complex gap = value(me) - value(j);
        const Complex unit = product_(j.at, j.at), own = product_(i, i);
        (j.conjugate ? right_conjugate : right)(j.at, i) = g(j, me) / gap;
        // Rows of the inverse are y_jᴴ/(y_jᴴ x_j).
        const Complex share = (p(me, j) - g(me, j) / gap) * own / (j.conjugate ? std::conj(unit) : unit);
        (j.conjugate ? left_conjugate : left)(j.at, i) = -std::conj(share);
      });
    }
    const ComplexMatrix X = pairs_.right, Y = pairs_.left;
    pairs_.right += X * right + X.conjugate() * right_conjugate + zero_share_;
    pairs_.left += Y * left + Y.conjugate() * left_conjugate;
    pairs_.right.colwise().normalize();
    pairs_.left.colwise().normalize();
  }

  void correct() {
    std::vector<std::vector<Member>> clusters(static_cast<std::size_t>(count_));
    for (Index i = 0; i < count_; ++i) clusters[static_cast<std::size_t>(root(i))].push_back({i, false});
    EigenPairs corrected;
    std::vector<EigenTrust> trust;
    alone_.clear();
    std::vector<Corrected> parts;
    for (std::size_t r = 0; r < clusters.size(); ++r) {
      auto& members = clusters[r];
      if (members.empty()) continue;
      const std::size_t half = members.size();
      for (std::size_t k = 0; k < half && closed_[r]; ++k) {
        if (!real(members[k].at)) members.push_back({members[k].at, true});
      }
      parts.push_back(correct_cluster(members, closed_[r]));
      for (std::size_t k = 0; k < parts.back().values.size(); ++k) {
        trust.push_back({parts.back().bound, false});
        alone_.push_back(half == 1 && !closed_[r] && !defective(members[0].at));
      }
      auto& values = parts.back().values;
      corrected.values.insert(corrected.values.end(), values.begin(), values.end());
    }
    count_ = static_cast<Index>(trust.size());
    corrected.right.resize(pairs_.right.rows(), count_);
    corrected.left.resize(pairs_.left.rows(), count_);
    Index at = 0;
    for (const Corrected& part : parts) {
      corrected.right.middleCols(at, part.right.cols()) = part.right;
      corrected.left.middleCols(at, part.left.cols()) = part.left;
      at += part.right.cols();
    }
    pairs_ = std::move(corrected);
    trust_ = std::move(trust);
  }

  ComplexVector vector(const ComplexMatrix& of, const Member& m) const {
    return m.conjugate ? ComplexVector(of.col(m.at).conjugate()) : ComplexVector(of.col(m.at));
  }

  Corrected correct_cluster(const std::vector<Member>& members, bool closed) const {
    if (defective(members[0].at)) return unchanged(members, defective_bound_(members[0].at));
    const auto k = static_cast<Index>(members.size());
    // What couples the cluster with the rest, to second order.
    double rest = 0, floor = 0, modulus = 0, row = 0, closest = std::numeric_limits<double>::infinity();
    for (const Member& m : members) {
      double sum = 0, radius = 0;
      for_others(m.at, [&](const Member& j) {
        if (root(j.at) == root(m.at) && (closed || !j.conjugate)) return;
        const double gap = std::abs(value({m.at, false}) - value(j));
        radius += std::abs(g({m.at, false}, j));
        closest = std::min(closest, gap);
        sum += (std::abs(g({m.at, false}, j)) / gap + std::abs(p({m.at, false}, j))) * std::abs(g(j, {m.at, false}));
      });
      rest = std::max(rest, sum + zero_coupling_(m.at));
      row = std::max(row, radius);
      floor = std::max(floor, floor_(m.at));
      modulus = std::max(modulus, std::abs(value(m)));
    }
    // Where the second order is not small against the gaps, the radius of Gershgorin's disc holds without any order.
    if (rest > 1e-5 * closest) rest += row;
    const double written = 2 * eps * modulus, outside = 2 * static_cast<double>(k) * rest + floor + written;
    Corrected out;
    if (k == 1) {
      const Member& me = members[0];
      Complex v = value(me) + g(me, me);
      if (real(me.at)) v.imag(0);
      out = {{v}, pairs_.right.col(me.at), pairs_.left.col(me.at), outside};
      if (std::isfinite(outside) && std::isfinite(std::abs(v)) && (real(me.at) || v.imag() > 0)) return out;
      return unchanged(members, std::numeric_limits<double>::infinity());
    }
    ComplexMatrix along(k, k), product(k, k);
    const auto member = [&](Index a) { return members[static_cast<std::size_t>(a)]; };
    for (Index a = 0; a < k; ++a) {
      for (Index b = 0; b < k; ++b) along(a, b) = g(member(a), member(b)), product(a, b) = p(member(a), member(b));
    }
    LongMatrix G = product.cast<LongComplex>().fullPivLu().solve(along.cast<LongComplex>());
    const auto inside = static_cast<double>(G.norm());
    if (!std::isfinite(inside)) return unchanged(members, std::numeric_limits<double>::infinity());

    // The cluster on its own: Λ + G, measured from its centre.
    Complex centre = 0;
    for (const Member& m : members) centre += value(m) / static_cast<double>(k);
    for (Index a = 0; a < k; ++a) G(a, a) += LongComplex(value(member(a))) - LongComplex(centre);
    const Eigen::ComplexEigenSolver<LongMatrix> small(G);
    const ComplexMatrix Z = small.eigenvectors().cast<Complex>();
    const double condition = condition_number(Z);
    if (condition > 1e6) return unchanged(members, 2 * inside + outside);
    out.bound = condition * (outside - written + eps * condition_number(product) * inside +
                             128 * long_eps * static_cast<double>(G.norm())) +
                written;
    const ComplexMatrix dual = (product * Z).inverse().adjoint();
    bool all_real = true;
    for (const Member& m : members) all_real = all_real && real(m.at);
    ComplexMatrix X(pairs_.right.rows(), k), Y = X;
    for (Index a = 0; a < k; ++a) X.col(a) = vector(pairs_.right, member(a)), Y.col(a) = vector(pairs_.left, member(a));
    // Y is dual to X up to the units of g.
    for (Index a = 0; a < k; ++a) Y.col(a) /= std::conj(Y.col(a).dot(X.col(a)));
    const bool symmetric = all_real || closed;
    double off = 0;
    std::vector<Index> kept;
    for (Index a = 0; a < k; ++a) {
      Complex v(centre + Complex(small.eigenvalues()(a)));
      if (symmetric && std::abs(v.imag()) <= out.bound) {
        off = std::max(off, std::abs(v.imag()));
        v.imag(0);
      }
      if (v.imag() < 0 && symmetric) continue;
      out.values.push_back(v);
      kept.push_back(a);
    }
    out.bound += off;
    // The count of real and complex ones must make up the cluster.
    std::size_t total = 0;
    for (const Complex& v : out.values) total += symmetric && v.imag() != 0 ? 2 : 1;
    if (total != members.size()) return unchanged(members, 2 * inside + outside);
    out.right.resize(X.rows(), static_cast<Index>(kept.size()));
    out.left.resize(X.rows(), static_cast<Index>(kept.size()));
    for (std::size_t a = 0; a < kept.size(); ++a) {
      const auto at = static_cast<Index>(a);
      out.right.col(at) = X * Z.col(kept[a]);
      out.left.col(at) = Y * dual.col(kept[a]);
    }
    out.right.colwise().normalize();
    out.left.colwise().normalize();
    return out;
  }

  static double condition_number(const ComplexMatrix& m) {
    const Eigen::JacobiSVD<ComplexMatrix> svd(m);
    const double least = svd.singularValues()(m.cols() - 1);
    return least > 0 ? svd.singularValues()(0) / least : std::numeric_limits<double>::infinity();
  }

  Corrected unchanged(const std::vector<Member>& members, double bound) const {
    Corrected out;
    out.bound = bound;
    std::vector<Index> at;
    for (const Member& m : members) {
      if (m.conjugate) continue;
      out.values.push_back(value(m));
      at.push_back(m.at);
    }
    out.right = pairs_.right(Eigen::all, at);
    out.left = pairs_.left(Eigen::all, at);
    return out;
  }

  // Eigenvalues no larger than what rounding makes of a zero, and known to few digits, may be one.
  void doubt_rounding() {
    const double size = eps * zero_.block.norm();
    for (Index i = 0; i < count_; ++i) {
      EigenTrust& trust = trust_[static_cast<std::size_t>(i)];
      const double modulus = std::abs(pairs_.values[static_cast<std::size_t>(i)]);
      const double condition = 1 / std::abs(pairs_.left.col(i).dot(pairs_.right.col(i)));
      if (!trust.refined && modulus <= condition * size && trust.bound > 1e-8 * modulus) trust.bound += modulus;
    }
  }

  // Whether nothing is left that only better vectors can tell: clusters, or bounds that are not small against the gaps.
  // Single eigenvalues that are small against the others are a matter of inverse iteration.
  bool settled() const {
    for (Index i = 0; i < count_; ++i) {
      const double bound = trust_[static_cast<std::size_t>(i)].bound;
      if (bound <= good_enough * std::abs(pairs_.values[static_cast<std::size_t>(i)])) continue;
      if (!alone_[static_cast<std::size_t>(i)] || !(bound < 1e-4 * nearest(i))) return false;
    }
    return true;
  }

  // Inverse iteration for what is still inexact against its own modulus.
  void invert() {
    std::vector<Index> wanted;
    for (Index i = 0; i < count_; ++i) {
      const double modulus = std::abs(pairs_.values[static_cast<std::size_t>(i)]);
      const double bound = trust_[static_cast<std::size_t>(i)].bound;
      if (alone_[static_cast<std::size_t>(i)] && bound > good_enough * modulus && bound < 0.01 * nearest(i))
        wanted.push_back(i);
    }
    if (wanted.empty()) return;
    std::stable_sort(wanted.begin(), wanted.end(), [&](Index a, Index b) {
      return std::abs(pairs_.values[static_cast<std::size_t>(a)]) <
             std::abs(pairs_.values[static_cast<std::size_t>(b)]);
    });
    if (wanted.size() > most_refined) wanted.resize(most_refined);
    ShiftedLu lu(equations_.pencil(), equations_.states());
    if (lu.predicted_entries() > most_factor_entries) return;
    for (const Index i : wanted) refine_one(lu, i);
  }

  double nearest(Index i) const {
    const Complex me = pairs_.values[static_cast<std::size_t>(i)];
    double gap = zero_.count > 0 ? std::abs(me) : std::numeric_limits<double>::infinity();
    for (Index j = 0; j < count_; ++j) {
      if (j != i) gap = std::min(gap, std::abs(me - value({j, false})));
      if (!real(j)) gap = std::min(gap, std::abs(me - value({j, true})));
    }
    return gap;
  }

  void refine_one(ShiftedLu& lu, Index i) {
    const auto at = static_cast<std::size_t>(i);
    const Complex start = pairs_.values[at];
    if (!lu.factor(start)) return;
    const Index n = equations_.states(), N = equations_.unknowns();
    ComplexVector w = ComplexVector::Zero(N), y = w;
    w.tail(n) = pairs_.right.col(i);
    y.tail(n) = pairs_.left.col(i);
    LongComplex lambda(start);
    double change = std::numeric_limits<double>::infinity(), floor = 0;
    for (int round = 0; round < 4; ++round) {
      w.head(N - n).setZero(), y.head(N - n).setZero();
      lu.solve(w), lu.solve_adjoint(y);
      w /= w.tail(n).norm(), y /= y.tail(n).norm();
      if (!w.allFinite() || !y.allFinite()) return;
      const Residual r = residual(equations_.pencil(), equations_.states(), lambda, w);
      const Complex unit = y.tail(n).dot(w.tail(n));
      const Complex delta = y.dot(r.value) / unit;
      floor = y.cwiseAbs().dot(r.rounding) / std::abs(unit);
      lambda += LongComplex(delta);
      change = std::abs(delta);
      if (round > 0 && change <= floor + eps * std::abs(start)) break;
    }
    Complex refined(static_cast<double>(lambda.real()), static_cast<double>(lambda.imag()));
    if (real(i)) refined.imag(0);
    const double bound = 4 * change + floor + eps * std::abs(refined);
    EigenTrust& trust = trust_[at];
    // Farther away than the bound would mean that another eigenvalue was found.
    if (std::abs(refined - start) > 2 * trust.bound || bound > trust.bound || (!real(i) && refined.imag() <= 0)) return;
    pairs_.values[at] = refined;
    pairs_.right.col(i) = w.tail(n);
    pairs_.left.col(i) = y.tail(n);
    trust = {bound, true};
  }

  const PerturbationEquations& equations_;
  const ZeroModes& zero_;
  EigenPairs& pairs_;
  Index count_;
  std::vector<EigenTrust> trust_;
  Eigen::VectorXd floor_, zero_coupling_;
  ComplexMatrix along_, along_conjugate_, product_, product_conjugate_;
  Eigen::VectorXd defective_bound_;  // 0 for an eigenvalue that is not
  ComplexMatrix zero_share_;
  std::vector<Index> group_;
  std::vector<bool> closed_;
  std::vector<bool> alone_;  // after the correction: not in a cluster
};

}  // namespace

std::vector<EigenTrust> refine(const PerturbationEquations& equations, const ZeroModes& zero, EigenPairs& pairs) {
  return Refiner(equations, zero, pairs).run();
}

}  // namespace dynalin

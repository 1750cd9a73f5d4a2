#include "linear/eigen_clusters.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "linear/pencil_residual.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using LongComplex = std::complex<long double>;
using Index = Eigen::Index;
using ComplexMatrix = Eigen::MatrixXcd;
using LongMatrix = Eigen::Matrix<LongComplex, Eigen::Dynamic, Eigen::Dynamic>;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

double condition_number(const ComplexMatrix& m) {
  const Eigen::JacobiSVD<ComplexMatrix> svd(m);
  const double least = svd.singularValues()(m.cols() - 1);
  return least > 0 ? svd.singularValues()(0) / least : infinity;
}

}  // namespace

// Equal eigenvalues always belong together.
EigenClusters::EigenClusters(const EigenPairs& pairs, const EigenResiduals& residuals)
    : pairs_(pairs), residuals_(residuals), group_(pairs.values.size()), closed_(pairs.values.size(), false) {
  std::iota(group_.begin(), group_.end(), Index{0});
  const Index count = residuals.count();
  for (Index i = 0; i < count; ++i) {
    if (residuals.defective(i)) continue;
    const Member me{i, false};
    residuals.for_others(i, [&](const Member& j) {
      const double gap = std::abs(value(pairs, me) - value(pairs, j));
      const double mixing = std::sqrt(std::abs(residuals.g(me, j)) * std::abs(residuals.g(j, me)));
      if (gap > 0 && mixing <= gap / 8 && std::abs(residuals.p(me, j)) * std::abs(residuals.p(j, me)) <= 1e-4) return;
      const Index a = root(i), b = root(j.at);
      group_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
      if (j.conjugate) closed_[static_cast<std::size_t>(std::min(a, b))] = true;
    });
  }
  for (Index i = 0; i < count; ++i) {
    if (closed_[static_cast<std::size_t>(i)]) closed_[static_cast<std::size_t>(root(i))] = true;
  }
}

EigenClusters::Corrected EigenClusters::corrected() const {
  std::vector<std::vector<Member>> clusters(group_.size());
  for (Index i = 0; i < residuals_.count(); ++i) clusters[static_cast<std::size_t>(root(i))].push_back({i, false});
  Corrected out;
  std::vector<Part> parts;
  for (std::size_t r = 0; r < clusters.size(); ++r) {
    auto& members = clusters[r];
    if (members.empty()) continue;
    const std::size_t half = members.size();
    for (std::size_t k = 0; k < half && closed_[r]; ++k) {
      if (!pairs_.real(members[k].at)) members.push_back({members[k].at, true});
    }
    const Part part = parts.emplace_back(correct(members, closed_[r]));
    out.pairs.values.insert(out.pairs.values.end(), part.values.begin(), part.values.end());
    out.trust.resize(out.pairs.values.size(), {part.bound, false});
    out.alone.resize(out.pairs.values.size(), half == 1 && !closed_[r] && !residuals_.defective(members[0].at));
  }
  const auto count = static_cast<Index>(out.trust.size());
  out.pairs.right.resize(pairs_.right.rows(), count);
  out.pairs.left.resize(pairs_.left.rows(), count);
  Index at = 0;
  for (const Part& part : parts) {
    out.pairs.right.middleCols(at, part.right.cols()) = part.right;
    out.pairs.left.middleCols(at, part.left.cols()) = part.left;
    at += part.right.cols();
  }
  return out;
}

EigenClusters::Part EigenClusters::correct(const std::vector<Member>& members, bool closed) const {
  const Index first = members[0].at;
  if (residuals_.defective(first)) return unchanged(members, residuals_.defective_bound(first));
  // What couples the cluster with the rest, to second order.
  double rest = 0, floor = 0, modulus = 0, row = 0, closest = infinity;
  for (const Member& m : members) {
    const Member own{m.at, false};
    double sum = 0, radius = 0;
    residuals_.for_others(m.at, [&](const Member& j) {
      if (together(m.at, j)) return;
      const double gap = std::abs(value(pairs_, own) - value(pairs_, j));
      const double onto = std::abs(residuals_.g(own, j));
      radius += onto;
      closest = std::min(closest, gap);
      sum += (onto / gap + std::abs(residuals_.p(own, j))) * std::abs(residuals_.g(j, own));
    });
    rest = std::max(rest, sum + residuals_.zero_coupling(m.at));
    row = std::max(row, radius);
    floor = std::max(floor, residuals_.floor(m.at));
    modulus = std::max(modulus, std::abs(value(pairs_, m)));
  }
  // Where the second order is not small against the gaps, the radius of Gershgorin's disc holds without any order.
  if (rest > 1e-5 * closest) rest += row;
  const double written = 2 * eps * modulus;
  const double outside = 2 * static_cast<double>(members.size()) * rest + floor + written;
  if (members.size() > 1) return correct_together(members, closed, outside, written);

  const Member& me = members[0];
  Complex v = value(pairs_, me) + residuals_.g(me, me);
  if (pairs_.real(first)) v.imag(0);
  if (std::isfinite(outside) && std::isfinite(std::abs(v)) && (pairs_.real(first) || v.imag() > 0))
    return {{v}, pairs_.right.col(first), pairs_.left.col(first), outside};
  return unchanged(members, infinity);
}

// The eigenvalues of the cluster on its own, Λ + G, measured from its centre.
EigenClusters::Part EigenClusters::correct_together(const std::vector<Member>& members, bool closed, double outside,
                                                    double written) const {
  const auto k = static_cast<Index>(members.size());
  const auto member = [&](Index a) -> const Member& { return members[static_cast<std::size_t>(a)]; };
  ComplexMatrix along(k, k), product(k, k);
  for (Index a = 0; a < k; ++a) {
    for (Index b = 0; b < k; ++b) {
      along(a, b) = residuals_.g(member(a), member(b));
      product(a, b) = residuals_.p(member(a), member(b));
    }
  }
  LongMatrix G = product.cast<LongComplex>().fullPivLu().solve(along.cast<LongComplex>());
  const auto inside = static_cast<double>(G.norm());
  if (!std::isfinite(inside)) return unchanged(members, infinity);

  Complex centre = 0;
  for (const Member& m : members) centre += value(pairs_, m) / static_cast<double>(k);
  for (Index a = 0; a < k; ++a) G(a, a) += LongComplex(value(pairs_, member(a))) - LongComplex(centre);
  const Eigen::ComplexEigenSolver<LongMatrix> small(G);
  const ComplexMatrix Z = small.eigenvectors().cast<Complex>();
  const double condition = condition_number(Z);
  if (condition > 1e6) return unchanged(members, 2 * inside + outside);
  Part out;
  out.bound = condition * (outside - written + eps * condition_number(product) * inside +
                           128 * long_eps * static_cast<double>(G.norm())) +
              written;

  const bool symmetric =
      closed || std::all_of(members.begin(), members.end(), [&](const Member& m) { return pairs_.real(m.at); });
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

  const ComplexMatrix X = columns(pairs_.right, members);
  ComplexMatrix Y = columns(pairs_.left, members);
  // Y is dual to X up to the units of g.
  for (Index a = 0; a < k; ++a) Y.col(a) /= std::conj(Y.col(a).dot(X.col(a)));
  const ComplexMatrix dual = (product * Z).inverse().adjoint();
  out.right = X * Z(Eigen::all, kept);
  out.left = Y * dual(Eigen::all, kept);
  out.right.colwise().normalize();
  out.left.colwise().normalize();
  return out;
}

EigenClusters::Part EigenClusters::unchanged(const std::vector<Member>& members, double bound) const {
  std::vector<Member> plain;
  for (const Member& m : members) {
    if (!m.conjugate) plain.push_back(m);
  }
  Part out;
  out.bound = bound;
  for (const Member& m : plain) out.values.push_back(value(pairs_, m));
  out.right = columns(pairs_.right, plain);
  out.left = columns(pairs_.left, plain);
  return out;
}

ComplexMatrix EigenClusters::columns(const ComplexMatrix& of, const std::vector<Member>& members) const {
  ComplexMatrix out(of.rows(), static_cast<Index>(members.size()));
  for (Index a = 0; a < out.cols(); ++a) {
    const Member& m = members[static_cast<std::size_t>(a)];
    out.col(a) = of.col(m.at);
    if (m.conjugate) out.col(a) = out.col(a).conjugate().eval();
  }
  return out;
}

}  // namespace dynalin

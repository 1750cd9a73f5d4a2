#include "eigenvalues/parallel_vectors.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/dense_products.h"
#include "base/dense_solvers.h"
#include "eigenvalues/balancing.h"
#include "eigenvalues/dual_vectors.h"
#include "eigenvalues/eigen_residuals.h"
#include "eigenvalues/index.h"
#include "eigenvalues/isolated_values.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using ComplexMatrix = Eigen::MatrixXcd;

// Of unit vectors: the angle between those of a root of multiplicity four is 1e-4 at most.
constexpr double one_direction = 1 - 1e-6;

struct Parallel {
  std::vector<Index> members;
  bool on_axis = false;  // one of them is real, or the mirror image of another
};

std::vector<Parallel> parallel_vectors(const EigenPairs& pairs) {
  const Index count = pairs.right.cols();
  const BothProducts products = both_products(pairs.right, pairs.right);
  std::vector<Index> group(at(count));
  std::iota(group.begin(), group.end(), Index{0});
  std::vector<bool> mirrored(at(count), false);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j <= i; ++j) {
      const bool image = !pairs.real(i) && std::abs(products.transposed(i, j)) >= one_direction;
      if (image) mirrored[at(i)] = mirrored[at(j)] = true;
      if (j == i || !(image || std::abs(products.adjoint(i, j)) >= one_direction)) continue;
      const Index from = std::max(group[at(i)], group[at(j)]), to = std::min(group[at(i)], group[at(j)]);
      std::replace(group.begin(), group.end(), from, to);
    }
  }
  std::vector<Parallel> found;
  for (Index i = 0; i < count; ++i) {
    if (group[at(i)] != i) continue;
    Parallel p;
    for (Index j = i; j < count; ++j) {
      if (group[at(j)] != i) continue;
      p.members.push_back(j);
      p.on_axis = p.on_axis || pairs.real(j) || mirrored[at(j)];
    }
    if (p.members.size() > 1 || mirrored[at(i)]) found.push_back(std::move(p));
  }
  return found;
}

// Orthonormal, real where the space is its own mirror image.
ComplexMatrix basis_of(const EigenPairs& pairs, const Parallel& group, const ComplexMatrix& vectors) {
  const ComplexMatrix own = vectors(Eigen::all, group.members);
  if (!group.on_axis) return columns_of_q(Eigen::HouseholderQR<ComplexMatrix>(own), own.cols());
  std::vector<Eigen::VectorXd> parts;
  for (const Index m : group.members) {
    parts.emplace_back(vectors.col(m).real());
    if (!pairs.real(m)) parts.emplace_back(vectors.col(m).imag());
  }
  Matrix all(vectors.rows(), static_cast<Index>(parts.size()));
  for (Index c = 0; c < all.cols(); ++c) all.col(c) = parts[at(c)];
  return columns_of_q(Eigen::ColPivHouseholderQR<Matrix>(all), all.cols()).cast<Complex>();
}

// The bases take the places of the vectors, those of mirror images as well at the end.
void put_bases(EigenPairs& pairs, std::vector<Parallel>& groups) {
  for (Parallel& group : groups) {
    const ComplexMatrix right = basis_of(pairs, group, pairs.right), left = basis_of(pairs, group, pairs.left);
    Complex mean = 0;
    for (const Index m : group.members) mean += value(pairs, {m, false}) / static_cast<double>(group.members.size());
    if (group.on_axis) mean.imag(0);
    while (static_cast<Index>(group.members.size()) < right.cols()) {
      group.members.push_back(static_cast<Index>(pairs.values.size()));
      pairs.values.emplace_back();
    }
    const auto count = static_cast<Index>(pairs.values.size());
    for (ComplexMatrix* side : {&pairs.right, &pairs.left}) side->conservativeResize(Eigen::NoChange, count);
    for (Index c = 0; c < right.cols(); ++c) {
      const Index m = group.members[at(c)];
      pairs.right.col(m) = right.col(c), pairs.left.col(m) = left.col(c), pairs.values[at(m)] = mean;
    }
  }
}

// Lengths of the members by powers of two for which all that couples them is of like size, as of a Jordan block whose
// rounding is as large as its ones: what mixes them is then what moves their values. The longest is at most so many
// powers of two beside the shortest: that they are dual to the left ones is known to rounding of the longest.
void balance(const Parallel& group, const EigenResiduals& residuals, int most, EigenPairs& pairs) {
  const auto k = static_cast<Index>(group.members.size());
  Matrix coupling = Matrix::Zero(k, k);
  for (Index a = 0; a < k; ++a) {
    for (Index b = 0; b < k; ++b) {
      const Index i = group.members[at(a)], j = group.members[at(b)];
      if (a != b) coupling(a, b) = std::abs(residuals.g({i, false}, {j, false})) + residuals.floor(i, j);
    }
  }
  const std::vector<int> power = balancing_powers(std::move(coupling));
  const auto [least, largest] = std::ranges::minmax(power);
  const double share = std::min(1.0, most / std::max(1.0, static_cast<double>(largest - least)));
  for (Index a = 0; a < k; ++a) {
    const double f = std::ldexp(1.0, static_cast<int>(std::lround(share * power[at(a)])));
    pairs.right.col(group.members[at(a)]) *= f, pairs.left.col(group.members[at(a)]) /= f;
  }
}

// Nothing if the vectors are no basis to work with.
std::optional<IsolatedValues> balanced_values(const StructuredPencil& pencil, const ZeroModes& zero,
                                              const std::vector<Parallel>& groups, const EigenPairs& unit,
                                              EigenPairs& pairs) {
  const EigenResiduals of_unit(pencil, zero, unit);
  if (!of_unit.complete()) return std::nullopt;
  for (const int most_powers : {50, 25, 12}) {
    pairs = unit;
    for (const Parallel& group : groups) balance(group, of_unit, most_powers, pairs);
    const EigenResiduals residuals(pencil, zero, pairs);
    if (auto isolated = isolated_values(pairs, residuals)) return isolated;
  }
  return std::nullopt;
}

// What the members of a group have in common, and the direction of it.
void make_one(const Parallel& group, const EigenPairs& as_given, GroupedValues& found) {
  const auto k = static_cast<double>(group.members.size());
  Complex mean = 0;
  for (const Index m : group.members) mean += found.pairs.values[at(m)] / k;
  if (group.on_axis) mean.imag(0);
  double bound = 0;
  for (const Index m : group.members)
    bound = std::max(bound, found.trust[at(m)].bound + std::abs(found.pairs.values[at(m)] - mean));
  const Index first = group.members.front();
  for (const Index m : group.members) {
    found.pairs.values[at(m)] = mean;
    found.trust[at(m)].bound = bound, found.trust[at(m)].cluster = static_cast<Index>(group.members.size());
    for (auto [side, given] : {std::pair{&found.pairs.right, &as_given.right}, {&found.pairs.left, &as_given.left}}) {
      side->col(m) = given->col(first);
      if (group.on_axis) side->col(m).imag().setZero();
    }
  }
}

}  // namespace

std::optional<GroupedValues> values_in_groups(const StructuredPencil& pencil, const ZeroModes& zero, EigenPairs pairs) {
  if (!pairs.right.allFinite() || !pairs.left.allFinite()) return std::nullopt;
  std::vector<Parallel> groups = parallel_vectors(pairs);
  if (groups.empty()) return std::nullopt;
  const EigenPairs as_given = pairs;
  put_bases(pairs, groups);
  const EigenPairs unit = with_dual_vectors(std::move(pairs));
  std::optional<IsolatedValues> isolated = balanced_values(pencil, zero, groups, unit, pairs);
  if (!isolated) return std::nullopt;
  GroupedValues found{std::move(pairs), std::move(isolated->trust)};
  found.pairs.values = std::move(isolated->values);
  for (const Parallel& group : groups) make_one(group, as_given, found);
  found.pairs.right.colwise().normalize();
  found.pairs.left.colwise().normalize();
  return found;
}

}  // namespace dynalin

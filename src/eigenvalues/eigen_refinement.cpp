#include "eigenvalues/eigen_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/dense_products.h"
#include "eigenvalues/dual_vectors.h"
#include "eigenvalues/eigen_residuals.h"
#include "eigenvalues/equal_values.h"
#include "eigenvalues/included_values.h"
#include "eigenvalues/inverse_iteration.h"
#include "eigenvalues/isolated_values.h"
#include "eigenvalues/parallel_vectors.h"
#include "eigenvalues/uncertainty_along.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using ComplexMatrix = Eigen::MatrixXcd;

constexpr double known_well_enough = 1e-13;  // bound against modulus

// Each vector takes the first-order share of the others that do not mix with it:
// x_i + Σ_j x_j G_ji/(λ_i − λ_j) and, dual to it, y_i − Σ_j y_j (p_ij + G_ij/(λ_j − λ_i))ᴴ.
void improve_vectors(const EigenResiduals& residuals, EigenPairs& pairs) {
  const Index count = residuals.count();
  ComplexMatrix right = ComplexMatrix::Zero(count, count), right_conjugate = right, left = right,
                left_conjugate = right;
  for (Index i = 0; i < count; ++i) {
    const Member me{i, false};
    residuals.for_others(i, [&](const Member& j) {
      const Complex gap = value(pairs, me) - value(pairs, j);
      // Nor where nothing tells two of them apart: equal values of parts that do not touch.
      if (8 * std::max(std::abs(residuals.g(j, me)), std::abs(residuals.g(me, j))) >= std::abs(gap)) return;
      const Complex unit = residuals.unit(j.at), own = residuals.unit(i);
      (j.conjugate ? right_conjugate : right)(j.at, i) = residuals.g(j, me) / gap;
      // Rows of the inverse are y_jᴴ/(y_jᴴ x_j).
      const Complex share =
          (residuals.p(me, j) - residuals.g(me, j) / gap) * own / (j.conjugate ? std::conj(unit) : unit);
      (j.conjugate ? left_conjugate : left)(j.at, i) = -std::conj(share);
    });
  }
  pairs.right +=
      product(pairs.right, right) + product(pairs.right.conjugate(), right_conjugate) + residuals.zero_share();
  pairs.left += product(pairs.left, left) + product(pairs.left.conjugate(), left_conjugate);
  pairs.right.colwise().normalize();
  pairs.left.colwise().normalize();
}

// The distance of each eigenvalue from all others.
std::vector<double> nearest(const ZeroModes& zero, const EigenPairs& pairs) {
  const auto count = static_cast<Index>(pairs.values.size());
  std::vector<double> gap;
  for (Index i = 0; i < count; ++i) {
    const Complex me = value(pairs, {i, false});
    double least = zero.count > 0 ? std::abs(me) : std::numeric_limits<double>::infinity();
    for (Index j = 0; j < count; ++j) {
      if (j != i) least = std::min(least, std::abs(me - value(pairs, {j, false})));
      if (!pairs.real(j)) least = std::min(least, std::abs(me - value(pairs, {j, true})));
    }
    gap.push_back(least);
  }
  return gap;
}

// Eigenvalues whose bound is not small against their modulus, nor close to the least that it may be.
std::vector<Index> inexact(const EigenPairs& pairs, const std::vector<EigenTrust>& trust) {
  std::vector<Index> found;
  for (std::size_t i = 0; i < trust.size(); ++i) {
    const double enough = known_well_enough * std::abs(pairs.values[i]) + 1.1 * trust[i].unknown;
    if (!(trust[i].bound <= enough)) found.push_back(static_cast<Index>(i));
  }
  return found;
}

double largest_bound(const std::vector<EigenTrust>& trust) {
  double bound = 0;
  for (const EigenTrust& t : trust) bound = std::max(bound, t.bound);
  return bound;
}

// Single eigenvalues no larger than what rounding makes of a zero, and known to few digits, may be one.
void doubt_rounding(const ZeroModes& zero, const EigenPairs& pairs, std::vector<EigenTrust>& trust) {
  const double size = std::numeric_limits<double>::epsilon() * zero.block.norm();
  for (std::size_t i = 0; i < trust.size(); ++i) {
    const double modulus = std::abs(pairs.values[i]);
    const auto at = static_cast<Index>(i);
    const double condition = 1 / std::abs(pairs.left.col(at).dot(pairs.right.col(at)));
    if (trust[i].cluster > 1 || trust[i].refined) continue;
    if (modulus <= condition * size && trust[i].bound > 1e-8 * modulus) trust[i].bound += modulus;
  }
}

// A pair whose bound reaches the axis may be two real values: what is defective next to zero tells in its invariant
// subspace alone, which is worth a bound a few times as wide.
bool reaches_its_mirror(const EigenPairs& pairs, const std::vector<EigenTrust>& trust) {
  for (std::size_t i = 0; i < trust.size(); ++i) {
    if (pairs.values[i].imag() != 0 && trust[i].bound >= std::abs(pairs.values[i].imag())) return true;
  }
  return false;
}

}  // namespace

std::vector<EigenTrust> refine(const StructuredPencil& pencil, const ZeroModes& zero, EigenPairs& pairs) {
  separate_equal_values(pencil.equations(), pairs);
  pairs = with_dual_vectors(std::move(pairs));
  std::vector<EigenTrust> trust(pairs.values.size(), {std::numeric_limits<double>::infinity(), 0, false, 1});
  std::vector<double> gap;
  const auto well_apart = [&](Index i, double part) {
    const auto at = static_cast<std::size_t>(i);
    return trust[at].cluster == 1 && trust[at].bound < part * gap[at];
  };
  bool all_apart = false, any_apart = false;
  for (int pass = 0; pass < 2; ++pass) {
    const EigenResiduals residuals(pencil, zero, pairs);
    std::optional<IsolatedValues> found = isolated_values(pairs, residuals);
    if (!found) break;
    any_apart = true, all_apart = found->all, trust = std::move(found->trust);
    gap = nearest(zero, pairs);
    // Bounds that are not small against the gaps want better vectors. Eigenvalues that are small against the others are
    // a matter of inverse iteration.
    const std::vector<Index> left = inexact(pairs, trust);
    const bool settled = std::all_of(left.begin(), left.end(), [&](Index i) { return well_apart(i, 1e-4); });
    if (!settled && pass == 0) improve_vectors(residuals, pairs);
    pairs.values = std::move(found->values);
    if (settled) break;
  }
  if (!all_apart) {
    std::optional<IncludedValues> found = included_values(pencil, zero);
    const double no_wider = reaches_its_mirror(pairs, trust) ? 10 : 1;
    if (found && largest_bound(found->trust) <= no_wider * largest_bound(trust)) {
      pairs = std::move(found->pairs), trust = std::move(found->trust);
      const Eigen::MatrixXd along = uncertainty_along(pencil, pairs);
      for (std::size_t i = 0; i < trust.size(); ++i) {
        const auto at = static_cast<Index>(i);
        trust[i].unknown = along(at, at) / std::abs(pairs.left.col(at).dot(pairs.right.col(at)));
      }
    } else if (!found && !any_apart) {
      if (std::optional<GroupedValues> grouped = values_in_groups(pencil, zero, pairs))
        pairs = std::move(grouped->pairs), trust = std::move(grouped->trust);
    }
  }
  gap = nearest(zero, pairs);
  std::vector<Index> wanted = inexact(pairs, trust);
  std::erase_if(wanted, [&](Index i) { return !well_apart(i, 0.01); });
  refine_by_inverse_iteration(pencil, std::move(wanted), pairs, trust);
  doubt_rounding(zero, pairs, trust);
  return trust;
}

}  // namespace dynalin

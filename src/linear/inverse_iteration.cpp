#include "linear/inverse_iteration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "system/shifted_lu.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using LongComplex = std::complex<long double>;
using Index = Eigen::Index;
using ComplexVector = Eigen::VectorXcd;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr std::size_t most_refined = 100;
constexpr double most_factor_entries = 2e7;

void refine_one(const StructuredPencil& pencil, ShiftedLu& lu, Index i, EigenPairs& pairs, EigenTrust& trust) {
  Complex& value = pairs.values[static_cast<std::size_t>(i)];
  const Complex start = value;
  if (!lu.factor(start)) return;
  const Index n = pencil.equations().states(), N = pencil.equations().unknowns();
  ComplexVector w = ComplexVector::Zero(N), y = w;
  w.tail(n) = pairs.right.col(i);
  y.tail(n) = pairs.left.col(i);
  LongComplex lambda(start);
  double change = std::numeric_limits<double>::infinity(), floor = 0, unknown = 0;
  for (int round = 0; round < 4; ++round) {
    w.head(N - n).setZero(), y.head(N - n).setZero();
    lu.solve(w), lu.solve_adjoint(y);
    w /= w.tail(n).norm(), y /= y.tail(n).norm();
    if (!w.allFinite() || !y.allFinite()) return;
    const PencilResidual r = pencil.residual(lambda, w);
    const Complex unit = y.tail(n).dot(w.tail(n));
    if (unit == 0.0) return;
    const Complex delta = y.dot(r.value) / unit;
    floor = (y.cwiseAbs().dot(r.rounding) + first_order_margin * std::abs(y.dot(pencil.taken_out(w)))) / std::abs(unit);
    unknown = y.tail(n).cwiseAbs().dot(pencil.uncertainty() * w.tail(n).cwiseAbs()) / std::abs(unit);
    lambda += LongComplex(delta);
    change = std::abs(delta);
    if (round > 0 && change <= floor + eps * std::abs(start)) break;
  }
  Complex refined(static_cast<double>(lambda.real()), static_cast<double>(lambda.imag()));
  if (pairs.real(i)) refined.imag(0);
  const double bound = 4 * change + floor + unknown + eps * std::abs(refined);
  // The disc around the start holds this eigenvalue and no other; farther away another one was found.
  if (!(std::abs(refined - start) <= trust.bound && bound <= trust.bound)) return;
  if (!pairs.real(i) && refined.imag() <= 0) return;
  value = refined;
  pairs.right.col(i) = w.tail(n);
  pairs.left.col(i) = y.tail(n);
  trust = {bound, unknown, true, 1};
}

}  // namespace

void refine_by_inverse_iteration(const StructuredPencil& pencil, std::vector<Index> wanted, EigenPairs& pairs,
                                 std::vector<EigenTrust>& trust) {
  if (wanted.empty()) return;
  std::stable_sort(wanted.begin(), wanted.end(), [&](Index a, Index b) {
    return std::abs(value(pairs, {a, false})) < std::abs(value(pairs, {b, false}));
  });
  if (wanted.size() > most_refined) wanted.resize(most_refined);
  ShiftedLu lu(pencil.equations().products(), pencil.equations().states());
  if (lu.predicted_entries() > most_factor_entries) return;
  for (const Index i : wanted) refine_one(pencil, lu, i, pairs, trust[static_cast<std::size_t>(i)]);
}

}  // namespace dynalin

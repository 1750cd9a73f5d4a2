#include "eigenvalues/inverse_iteration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "eigenvalues/rounding.h"
#include "eigenvalues/uncertainty_along.h"
#include "system/shifted_lu.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using LongComplex = std::complex<long double>;
using Index = Eigen::Index;
using ComplexVector = Eigen::VectorXcd;

constexpr std::size_t most_refined = 100;
constexpr double most_factor_entries = 2e7;
constexpr int most_refinements = 6;
constexpr double most_contraction = 0.5;  // of the error of a vector in a round
constexpr double settled = 64 * eps;      // of a vector of unit length

// One pair (λ, w, y) of the pencil, w and y with their algebraic parts.
class Refinement {
 public:
  Refinement(const StructuredPencil& pencil, const ShiftedLu& lu, Complex start)
      : pencil_(pencil), lu_(lu), states_(pencil.equations().states()), lambda_(start) {}

  // False where the vectors do not converge.
  bool run(const ComplexVector& right, const ComplexVector& left) {
    const Index N = pencil_.equations().unknowns();
    w_ = ComplexVector::Zero(N), y_ = w_;
    w_.tail(states_) = right, y_.tail(states_) = left;
    lu_.solve(w_), lu_.solve_adjoint(y_);
    if (!normalized()) return false;
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0;; ++round) {
      lambda_ += LongComplex(quotient());
      // The error of w as its residual shows it, and not as another solution with these factors would repeat it.
      ComplexVector z = pencil_.residual(lambda_, w_).value, v = pencil_.left_residual(lambda_, y_);
      const Eigen::VectorXd of_left = v.cwiseAbs();
      lu_.solve(z), lu_.solve_adjoint(v);
      z -= w_ * (of_states(y_, z) / unit_);
      v -= y_ * (of_states(w_, v) / std::conj(unit_));
      const double size = z.tail(states_).norm();
      second_order_ = of_left.dot(z.cwiseAbs()) / std::abs(unit_);
      const bool contracts = size <= most_contraction * before || size <= settled;
      const bool enough = second_order_ <= floor_ + eps * std::abs(value());
      if (round > 0 && (enough || !contracts || round == most_refinements)) return contracts;
      before = size;
      w_ -= z, y_ -= v;
      if (!normalized()) return false;
    }
  }

  Complex value() const { return {static_cast<double>(lambda_.real()), static_cast<double>(lambda_.imag())}; }
  ComplexVector right() const { return w_.tail(states_); }
  ComplexVector left() const { return y_.tail(states_); }
  // |(S − λE)ᴴ y| · |z| with z the error of w is all that the quotient misses; z is known to a few digits.
  double error() const { return first_order_margin * second_order_ + floor_ + eps * std::abs(value()); }
  // By what is not known of the state matrix.
  double unknown() const { return uncertainty_along(pencil_, y_, w_) / std::abs(unit_); }

 private:
  Complex of_states(const ComplexVector& a, const ComplexVector& b) const {
    return a.tail(states_).dot(b.tail(states_));
  }
  bool normalized() {
    w_ /= w_.tail(states_).norm(), y_ /= y_.tail(states_).norm();
    unit_ = of_states(y_, w_);
    return w_.allFinite() && y_.allFinite() && unit_ != 0.0;
  }
  // What the generalized Rayleigh quotient changes of λ.
  Complex quotient() {
    const PencilResidual r = pencil_.residual(lambda_, w_);
    floor_ = (y_.cwiseAbs().dot(r.rounding) + first_order_margin * std::abs(y_.dot(pencil_.taken_out(w_)))) /
             std::abs(unit_);
    return y_.dot(r.value) / unit_;
  }

  const StructuredPencil& pencil_;
  const ShiftedLu& lu_;
  const Index states_;
  LongComplex lambda_;
  ComplexVector w_, y_;
  Complex unit_ = 0;
  double floor_ = 0, second_order_ = 0;
};

void refine_one(const StructuredPencil& pencil, ShiftedLu& lu, Index i, EigenPairs& pairs, EigenTrust& trust) {
  Complex& value = pairs.values[static_cast<std::size_t>(i)];
  if (!lu.factor(value)) return;
  Refinement refinement(pencil, lu, value);
  if (!refinement.run(pairs.right.col(i), pairs.left.col(i))) return;
  Complex refined = refinement.value();
  if (pairs.real(i)) refined.imag(0);
  const double unknown = refinement.unknown(), bound = refinement.error() + unknown;
  // The disc around the start holds this eigenvalue and no other; farther away another one was found.
  if (!(std::abs(refined - value) <= trust.bound && bound <= trust.bound)) return;
  if (!pairs.real(i) && refined.imag() <= 0) return;
  value = refined;
  pairs.right.col(i) = refinement.right();
  pairs.left.col(i) = refinement.left();
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
  // Each thread has factors of its own.
  const std::size_t shares = std::min(thread_count(), wanted.size());
  in_parallel(shares, [&](std::size_t share) {
    ShiftedLu lu(pencil.equations().products(), pencil.equations().states());
    if (lu.predicted_entries() > most_factor_entries) return;
    for (std::size_t k = share; k < wanted.size(); k += shares)
      refine_one(pencil, lu, wanted[k], pairs, trust[static_cast<std::size_t>(wanted[k])]);
  });
}

}  // namespace dynalin

#include "linear/shift_inverse.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace dynalin {

using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;

ComplexVector arbitrary_vector(Eigen::Index size, unsigned number) {
  std::mt19937_64 generator(number);
  // Of a distribution that is the same everywhere.
  const auto next = [&] { return std::ldexp(static_cast<double>(generator() >> 11), -52) - 1; };
  ComplexVector v(size);
  for (Complex& e : v) {
    const double re = next();
    e = {re, next()};
  }
  return v;
}

ShiftInverse::ShiftInverse(const PerturbationEquations& equations)
    : unknowns_(equations.unknowns()),
      lu_(equations.products(), equations.states()),
      unit_(Eigen::VectorXd::Ones(equations.states())) {}

bool ShiftInverse::move_to(Complex shift) {
  shift_ = shift;
  if (!lu_.factor(shift)) return false;
  ComplexVector probe = arbitrary_vector(states(), 1);
  apply(probe);
  return probe.allFinite();
}

void ShiftInverse::find_units(const std::vector<int>& kind) {
  constexpr int probes = 3, steps = 2;
  constexpr double least_share = 1e-3;
  Eigen::VectorXd size = Eigen::VectorXd::Zero(states());
  for (int p = 0; p < probes; ++p) {
    ComplexVector x = arbitrary_vector(states(), static_cast<unsigned>(11 + p)).cwiseProduct(unit_);
    for (int s = 0; s < steps; ++s) {
      x = x.cwiseQuotient(unit_);
      apply(x);
      x = x.cwiseProduct(unit_);
      const double largest = x.cwiseAbs().maxCoeff();
      if (!(largest > 0) || !std::isfinite(largest)) return;
      x /= largest;
    }
    size += x.cwiseAbs2();
  }
  size = size.cwiseSqrt();
  std::vector<double> most(1 + static_cast<std::size_t>(*std::max_element(kind.begin(), kind.end())), 0.0);
  const auto of = [&](Eigen::Index k) -> double& {
    return most[static_cast<std::size_t>(kind[static_cast<std::size_t>(k)])];
  };
  for (Eigen::Index k = 0; k < states(); ++k) of(k) = std::max(of(k), size(k));
  const double all = size.maxCoeff();
  for (Eigen::Index k = 0; k < states(); ++k) {
    // Powers of two: nothing is rounded by units.
    const double unit = std::max({size(k), least_share * of(k), 1e-12 * all});
    unit_(k) = std::exp2(std::round(std::log2(unit)));
  }
}

void ShiftInverse::apply(ComplexVector& x) const {
  ComplexVector b = ComplexVector::Zero(unknowns_);
  b.tail(states()) = x.cwiseProduct(unit_);
  lu_.solve(b);
  x = b.tail(states()).cwiseQuotient(unit_);
}

void ShiftInverse::apply_adjoint(ComplexVector& y) const {
  ComplexVector b = ComplexVector::Zero(unknowns_);
  b.tail(states()) = y.cwiseQuotient(unit_);
  lu_.solve_adjoint(b);
  y = b.tail(states()).cwiseProduct(unit_);
}

}  // namespace dynalin

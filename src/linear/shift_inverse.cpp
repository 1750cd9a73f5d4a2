#include "linear/shift_inverse.h"

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

void ShiftInverse::find_units() {
  constexpr int rounds = 5;
  constexpr double least_share = 1e-8;
  for (int round = 0; round < rounds; ++round) {
    ComplexVector of_rows = arbitrary_vector(states(), static_cast<unsigned>(11 + round)), of_columns = of_rows;
    apply(of_rows), apply_adjoint(of_columns);
    const Eigen::VectorXd row = of_rows.cwiseAbs(), column = of_columns.cwiseAbs();
    if (!row.allFinite() || !column.allFinite()) return;
    const double least_row = least_share * row.maxCoeff(), least_column = least_share * column.maxCoeff();
    for (Eigen::Index k = 0; k < states(); ++k) {
      if (!(row(k) > 0 && column(k) > 0) || (row(k) < least_row && column(k) < least_column)) continue;
      // Powers of two: nothing is rounded by units.
      unit_(k) *= std::exp2(std::round(0.5 * std::log2(row(k) / column(k))));
    }
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

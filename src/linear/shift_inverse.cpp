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

ShiftInverse::ShiftInverse(const PerturbationEquations& equations, std::shared_ptr<const ConservativeModel> model)
    : equations_(equations), unknowns_(equations.unknowns()), unit_(Eigen::VectorXd::Ones(equations.states())) {
  if (model) symmetric_.emplace(std::move(model), FactorsFor::solving);
}

ShiftedLu& ShiftInverse::factors() {
  if (!lu_) lu_.emplace(equations_.products(), equations_.states());
  return *lu_;
}

// The shift of ω² is −σ².
bool ShiftInverse::move_to(Complex shift) {
  shift_ = shift;
  if (!(symmetric_ ? symmetric_->factor(-(shift * shift).real()) : factors().factor(shift))) return false;
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
  if (symmetric_) return apply_symmetric(x);
  ComplexVector b = ComplexVector::Zero(unknowns_);
  b.tail(states()) = x.cwiseProduct(unit_);
  lu_->solve(b);
  x = b.tail(states()).cwiseQuotient(unit_);
}

void ShiftInverse::apply_adjoint(ComplexVector& y) const {
  if (symmetric_) return apply_symmetric_adjoint(y);
  ComplexVector b = ComplexVector::Zero(unknowns_);
  b.tail(states()) = y.cwiseQuotient(unit_);
  lu_->solve_adjoint(b);
  y = b.tail(states()).cwiseProduct(unit_);
}

namespace {

Eigen::MatrixXd parts(const ComplexVector& v) {
  Eigen::MatrixXd m(v.size(), 2);
  m << v.real(), v.imag();
  return m;
}
Complex complex(const Eigen::MatrixXd& m, Eigen::Index k) { return {m(k, 0), m(k, 1)}; }

}  // namespace

// (A − σ)(r; p) = b of rates and positions: r = b_p + σ p, and −(K + σ² M) p = M (b_r + σ b_p) along the constraints.
void ShiftInverse::apply_symmetric(ComplexVector& x) const {
  const ConservativeModel& model = symmetric_->model();
  const ComplexVector b = x.cwiseProduct(unit_);
  ComplexVector h = ComplexVector::Zero(states());
  for (std::size_t k = 0; k < model.positions().size(); ++k)
    h(model.positions()[k]) = b(model.rates()[k]) + shift_ * b(model.positions()[k]);
  const Eigen::MatrixXd p = model.states_of(symmetric_->solve(model.forces(parts(ComplexVector(model.motions(h))))));
  for (std::size_t k = 0; k < model.positions().size(); ++k) {
    const Eigen::Index position = model.positions()[k], rate = model.rates()[k];
    x(position) = -complex(p, position);
    x(rate) = b(position) + shift_ * x(position);
  }
  x = x.cwiseQuotient(unit_).eval();
}

void ShiftInverse::apply_symmetric_adjoint(ComplexVector& y) const {
  const ConservativeModel& model = symmetric_->model();
  const ComplexVector c = y.cwiseQuotient(unit_);
  const Complex conjugate = std::conj(shift_);
  ComplexVector h = ComplexVector::Zero(states());
  for (std::size_t k = 0; k < model.positions().size(); ++k)
    h(model.positions()[k]) = c(model.positions()[k]) + conjugate * c(model.rates()[k]);
  const Eigen::MatrixXd r =
      model.motions_transposed(model.forces(symmetric_->solve(model.states_transposed(parts(h)))));
  for (std::size_t k = 0; k < model.positions().size(); ++k) {
    const Eigen::Index position = model.positions()[k], rate = model.rates()[k];
    y(rate) = -complex(r, position);
    y(position) = c(rate) + conjugate * y(rate);
  }
  y = y.cwiseProduct(unit_).eval();
}

}  // namespace dynalin

#include "selected_modes/shift_inverse.h"

#include <cmath>

#include "base/arbitrary_vector.h"
#include "base/dense_products.h"

namespace dynalin {

using Complex = std::complex<double>;
using Matrix = Eigen::MatrixXd;
using ComplexVector = Eigen::VectorXcd;
using ComplexMatrix = Eigen::MatrixXcd;

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
    in_parallel(2, [&](std::size_t side) { side == 0 ? apply(of_rows) : apply_adjoint(of_columns); });
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

void ShiftInverse::apply(Eigen::Ref<ComplexMatrix> x) const {
  if (symmetric_) return apply_symmetric(x);
  for (auto column : x.colwise()) {
    ComplexVector b = ComplexVector::Zero(unknowns_);
    b.tail(states()) = column.cwiseProduct(unit_);
    lu_->solve(b);
    column = b.tail(states()).cwiseQuotient(unit_);
  }
}

void ShiftInverse::apply_adjoint(Eigen::Ref<ComplexMatrix> y) const {
  if (symmetric_) return apply_symmetric_adjoint(y);
  for (auto column : y.colwise()) {
    ComplexVector b = ComplexVector::Zero(unknowns_);
    b.tail(states()) = column.cwiseQuotient(unit_);
    lu_->solve_adjoint(b);
    column = b.tail(states()).cwiseProduct(unit_);
  }
}

// (A − σ)(r; p) = b of rates and positions: r = b_p + σ p, and −(K + σ² M) p = M (b_r + σ b_p) along the constraints.
void ShiftInverse::apply_symmetric(Eigen::Ref<ComplexMatrix> x) const {
  const ConservativeModel& model = symmetric_->model();
  const ComplexMatrix b = unit_.asDiagonal() * x;
  ComplexMatrix h = ComplexMatrix::Zero(states(), x.cols());
  for (std::size_t k = 0; k < model.positions().size(); ++k)
    h.row(model.positions()[k]) = b.row(model.rates()[k]) + shift_ * b.row(model.positions()[k]);
  const ComplexMatrix p = by_parts(model.motions(h), [&](const Matrix& motions) {
    return model.states_of(symmetric_->solve(model.forces(motions)));
  });
  for (std::size_t k = 0; k < model.positions().size(); ++k) {
    const Eigen::Index position = model.positions()[k], rate = model.rates()[k];
    x.row(position) = -p.row(position);
    x.row(rate) = b.row(position) + shift_ * x.row(position);
  }
  x = (unit_.cwiseInverse().asDiagonal() * x).eval();
}

void ShiftInverse::apply_symmetric_adjoint(Eigen::Ref<ComplexMatrix> y) const {
  const ConservativeModel& model = symmetric_->model();
  const ComplexMatrix c = unit_.cwiseInverse().asDiagonal() * y;
  const Complex conjugate = std::conj(shift_);
  ComplexMatrix h = ComplexMatrix::Zero(states(), y.cols());
  for (std::size_t k = 0; k < model.positions().size(); ++k)
    h.row(model.positions()[k]) = c.row(model.positions()[k]) + conjugate * c.row(model.rates()[k]);
  const ComplexMatrix r = by_parts(h, [&](const Matrix& of_states) {
    return model.motions_transposed(model.forces(symmetric_->solve(model.states_transposed(of_states))));
  });
  for (std::size_t k = 0; k < model.positions().size(); ++k) {
    const Eigen::Index position = model.positions()[k], rate = model.rates()[k];
    y.row(rate) = -r.row(position);
    y.row(position) = c.row(rate) + conjugate * y.row(rate);
  }
  y = (unit_.asDiagonal() * y).eval();
}

}  // namespace dynalin

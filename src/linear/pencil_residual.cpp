#include "linear/pencil_residual.h"

#include <cmath>
#include <vector>

namespace dynalin {

using LongComplex = std::complex<long double>;

PencilResidual pencil_residual(const ColumnMatrix& S, std::int32_t states, LongComplex lambda,
                               const Eigen::VectorXcd& w) {
  const auto n = static_cast<std::size_t>(S.rows);
  std::vector<LongComplex> sum(n);
  PencilResidual r;
  r.rounding = Eigen::VectorXd::Zero(S.rows);
  Eigen::VectorXd terms = Eigen::VectorXd::Constant(S.rows, 2);
  for (std::int32_t c = 0; c < S.columns; ++c) {
    const LongComplex x(w(c));
    const double magnitude = std::abs(w(c).real()) + std::abs(w(c).imag());
    if (magnitude == 0) continue;
    for_each_in_column(S, c, [&](std::int32_t row, double v) {
      sum[static_cast<std::size_t>(row)] += static_cast<long double>(v) * x;
      r.rounding(row) += std::abs(v) * magnitude;
      ++terms(row);
    });
  }
  const auto modulus = static_cast<double>(std::abs(lambda));
  for (std::int32_t c = S.columns - states; c < S.columns; ++c) {
    sum[static_cast<std::size_t>(c)] -= lambda * LongComplex(w(c));
    r.rounding(c) += 2 * modulus * std::abs(w(c));
  }
  r.rounding.array() *= long_eps * terms.array();
  r.value.resize(S.rows);
  for (std::size_t k = 0; k < n; ++k) {
    r.value(static_cast<Eigen::Index>(k)) = {static_cast<double>(sum[k].real()), static_cast<double>(sum[k].imag())};
  }
  return r;
}

StructuredPencil::StructuredPencil(const PerturbationEquations& equations, const ZeroModes& zero,
                                   const Eigen::MatrixXd& uncertainty)
    : equations_(equations), uncertainty_(uncertainty) {
  const Eigen::Index z = zero.count, n = equations.states();
  const Eigen::MatrixXd T0 = zero.right().leftCols(z);
  shares_ = zero.left().leftCols(z).transpose();
  residuals_.resize(equations.unknowns(), z);
  if (z == 0) return;
  const Eigen::MatrixXd a = equations.complete(T0);
  for (Eigen::Index c = 0; c < z; ++c) {
    Eigen::VectorXcd w(equations.unknowns());
    w << a.col(c).cast<std::complex<double>>(), T0.col(c).cast<std::complex<double>>();
    residuals_.col(c) = pencil_residual(equations.pencil(), equations.states(), 0, w).value.real();
  }
  residuals_.bottomRows(n) -= T0 * zero.block.topLeftCorner(z, z);
}

PencilResidual StructuredPencil::residual(LongComplex lambda, const Eigen::VectorXcd& w) const {
  PencilResidual r = pencil_residual(equations_.pencil(), equations_.states(), lambda, w);
  r.value -= taken_out(w);
  return r;
}

Eigen::VectorXcd StructuredPencil::taken_out(const Eigen::VectorXcd& w) const {
  const Eigen::VectorXcd along = shares_ * w.tail(equations_.states());
  return residuals_ * along;
}

}  // namespace dynalin

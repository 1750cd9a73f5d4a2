#include "eigenvalues/pencil_residual.h"

#include <cmath>

#include "eigenvalues/transposed.h"

namespace dynalin {

using LongComplex = std::complex<long double>;

StructuredPencil::StructuredPencil(const PerturbationEquations& equations, const ZeroModes& zero,
                                   const Eigen::MatrixXd& uncertainty, const Eigen::MatrixXd& beside_coefficients)
    : equations_(equations),
      uncertainty_(uncertainty),
      beside_coefficients_(beside_coefficients),
      rows_(transposed(equations.products())) {
  const Eigen::Index z = zero.count, n = equations.states();
  const Eigen::MatrixXd T0 = zero.right().leftCols(z);
  shares_ = zero.left().leftCols(z).transpose();
  residuals_.resize(equations.unknowns(), z);
  if (z == 0) return;
  const Eigen::MatrixXd a = equations.complete(T0);
  for (Eigen::Index c = 0; c < z; ++c) {
    Eigen::VectorXcd w(equations.unknowns());
    w << a.col(c).cast<std::complex<double>>(), T0.col(c).cast<std::complex<double>>();
    residuals_.col(c) = as_assembled(0, w).value.real();
  }
  residuals_.bottomRows(n) -= T0 * zero.block.topLeftCorner(z, z);
}

PencilResidual StructuredPencil::as_assembled(LongComplex lambda, const Eigen::VectorXcd& w) const {
  const Eigen::Index size = w.size(), first_state = size - equations_.states();
  const auto modulus = static_cast<double>(std::abs(lambda));
  const Eigen::VectorXd magnitude = w.real().cwiseAbs() + w.imag().cwiseAbs();
  PencilResidual r{Eigen::VectorXcd(size), Eigen::VectorXd(size)};
  for (Eigen::Index k = 0; k < size; ++k) {
    long double re = 0, im = 0;
    double sum = 0, terms = 2;
    for_each_in_column(rows_, static_cast<std::int32_t>(k), [&](std::int32_t c, double v) {
      re += static_cast<long double>(v) * static_cast<long double>(w(c).real());
      im += static_cast<long double>(v) * static_cast<long double>(w(c).imag());
      sum += std::abs(v) * magnitude(c);
      terms += magnitude(c) > 0 ? 1 : 0;
    });
    if (k >= first_state) {
      const auto x = static_cast<long double>(w(k).real()), y = static_cast<long double>(w(k).imag());
      re -= lambda.real() * x - lambda.imag() * y;
      im -= lambda.real() * y + lambda.imag() * x;
      sum += 2 * modulus * std::abs(w(k));
    }
    r.value(k) = {static_cast<double>(re), static_cast<double>(im)};
    r.rounding(k) = long_eps * terms * sum;
  }
  return r;
}

PencilResidual StructuredPencil::residual(LongComplex lambda, const Eigen::VectorXcd& w) const {
  PencilResidual r = as_assembled(lambda, w);
  if (residuals_.cols() > 0) r.value -= taken_out(w);
  return r;
}

Eigen::VectorXcd StructuredPencil::left_residual(LongComplex lambda, const Eigen::VectorXcd& y) const {
  const Eigen::Index size = y.size(), first_state = size - equations_.states();
  Eigen::VectorXcd out(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    LongComplex sum = 0;
    for_each_in_column(equations_.products(), static_cast<std::int32_t>(k),
                       [&](std::int32_t r, double v) { sum += static_cast<long double>(v) * LongComplex(y(r)); });
    if (k >= first_state) sum -= std::conj(lambda) * LongComplex(y(k));
    out(k) = {static_cast<double>(sum.real()), static_cast<double>(sum.imag())};
  }
  if (residuals_.cols() > 0) out.tail(equations_.states()) -= shares_.transpose() * (residuals_.transpose() * y);
  return out;
}

Eigen::VectorXcd StructuredPencil::taken_out(const Eigen::VectorXcd& w) const {
  const Eigen::VectorXcd along = shares_ * w.tail(equations_.states());
  return residuals_ * along;
}

}  // namespace dynalin

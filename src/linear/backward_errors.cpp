#include "linear/backward_errors.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/cycle.h"
#include "linear/dense_products.h"
#include "linear/shift_inverse.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;

// What the equations leave, of all unknowns of x.
Matrix rates_of(const PerturbationEquations& equations, const Matrix& x, SparseLu::Refined refined) {
  Matrix w(equations.unknowns(), x.cols()), rates = Matrix::Zero(equations.unknowns(), x.cols());
  w.topRows(equations.state_columns()) = equations.complete(x, refined);
  w.bottomRows(x.rows()) = x;
  const auto size = static_cast<std::size_t>(w.rows());
  for (Index c = 0; c < x.cols(); ++c)
    equations.products().multiply_add({w.col(c).data(), size}, {rates.col(c).data(), size});
  return rates;
}

// Of a few states what A makes of each, of many what it makes of a few vectors of signs.
double norm_of_state_matrix(const PerturbationEquations& equations) {
  constexpr Index few = 64, probes = 4;
  const Index n = equations.states();
  Matrix x = Matrix::Identity(n, n <= few ? n : probes);
  if (n > few) {
    const double each = 1 / std::sqrt(static_cast<double>(probes));
    for (Index c = 0; c < probes; ++c) {
      const Eigen::VectorXcd v = arbitrary_vector(n, static_cast<unsigned>(51 + c));
      for (Index k = 0; k < n; ++k) x(k, c) = v(k).real() < 0 ? -each : each;
    }
  }
  Eigen::VectorXd norms(x.cols());
  for_few_columns(x.cols(), [&](Index first, Index count) {
    norms.segment(first, count) = rates_of(equations, x.middleCols(first, count), SparseLu::Refined::no)
                                      .bottomRows(n)
                                      .colwise()
                                      .norm()
                                      .transpose();
  });
  return norms.norm();
}

}  // namespace

void add_backward_errors(const PerturbationEquations& equations, EigenSolution& solution) {
  const double size = norm_of_state_matrix(equations);
  if (!(size > 0)) return;
  for_few_columns(solution.vectors.cols(), [&](Index first, Index count) {
    const Eigen::MatrixXcd images = by_parts(solution.vectors.middleCols(first, count), [&](const Matrix& x) {
      return equations.reduced(rates_of(equations, x, SparseLu::Refined::yes), SparseLu::Refined::no);
    });
    for (Index c = 0; c < count; ++c) {
      EigenMode& mode = solution.modes[static_cast<std::size_t>(first + c)];
      const Complex lambda = mode.eigenvalue_hz * cycle;
      mode.backward_error = (images.col(c) - lambda * solution.vectors.col(first + c)).norm() / size;
    }
  });
}

}  // namespace dynalin

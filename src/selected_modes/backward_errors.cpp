#include "selected_modes/backward_errors.h"

#include <cmath>
#include <complex>

#include "base/arbitrary_vector.h"
#include "base/dense_products.h"

namespace dynalin {

namespace {

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

}  // namespace

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
  for_few_columns(equations.unknowns(), x.cols(), [&](Index first, Index count) {
    norms.segment(first, count) = rates_of(equations, x.middleCols(first, count), SparseLu::Refined::no)
                                      .bottomRows(n)
                                      .colwise()
                                      .norm()
                                      .transpose();
  });
  return norms.norm();
}

Eigen::VectorXd sizes_of_images(const PerturbationEquations& equations, const Matrix& v) {
  Eigen::VectorXd sizes(v.cols());
  for_few_columns(equations.unknowns(), v.cols(), [&](Index first, Index count) {
    const Matrix rates = rates_of(equations, v.middleCols(first, count), SparseLu::Refined::yes);
    sizes.segment(first, count) = equations.reduced(rates, SparseLu::Refined::no).colwise().norm().transpose();
  });
  return sizes;
}

}  // namespace dynalin

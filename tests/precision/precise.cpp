#include "precision/precise.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace dynalin::precision {

namespace {

template <class Number>
std::vector<Value> eigenvalues_with(const PerturbationEquations& p) {
  using Dense = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  const Dense A = state_matrix<Number>(p);
  Eigen::EigenSolver<Dense> solver(A, false);
  if (solver.info() != Eigen::Success) solver.compute(A.transpose(), false);
  if (solver.info() != Eigen::Success) return {};
  std::vector<Value> values;
  for (Eigen::Index k = 0; k < solver.eigenvalues().size(); ++k) {
    values.push_back({Real(solver.eigenvalues()(k).real()), Real(solver.eigenvalues()(k).imag())});
  }
  return values;
}

}  // namespace

std::vector<Value> eigenvalues(const PerturbationEquations& p) { return eigenvalues_with<Real>(p); }
std::vector<Value> finer_eigenvalues(const PerturbationEquations& p) { return eigenvalues_with<Finer>(p); }

std::vector<Value> eigenvalues_within_rounding(const PerturbationEquations& p, std::mt19937_64& random) {
  const auto drawn = [&](double v) {
    int exponent = 0;
    const double digits = std::ldexp(std::frexp(v, &exponent), 26);
    if (digits == std::trunc(digits)) return static_cast<long double>(v);
    std::uniform_real_distribution<double> part(-1, 1);
    return v * (1.0L + part(random) * std::numeric_limits<double>::epsilon() / 2);
  };
  using Dense = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::EigenSolver<Dense> solver(state_matrix<long double>(p, drawn), false);
  std::vector<Value> values;
  if (solver.info() != Eigen::Success) return values;
  for (const std::complex<long double>& v : solver.eigenvalues()) values.push_back({Real(v.real()), Real(v.imag())});
  return values;
}

}  // namespace dynalin::precision

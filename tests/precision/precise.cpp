#include "precision/precise.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace dynalin::precision {

namespace {

// Solves F a = −G by elimination. Of the columns left that with the fewest entries is next, and of its rows with no
// small one the shortest: most entries are zero and stay so, and zeros cost nothing. The coefficients of the equations
// go through `as` first.
template <class Number = Real, class As = std::identity>
Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> state_matrix(const PerturbationEquations& p, As&& as = {}) {
  using std::abs;
  using Dense = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  const ColumnMatrix& S = p.products();
  const Eigen::Index N = p.unknowns(), n = p.states(), m = N - n;
  Dense M = Dense::Zero(N, N);
  for_each_entry(S, [&](std::int32_t r, std::int32_t c, double v) { M(r, c) += Number(as(v)); });
  std::vector<Eigen::Index> used;
  const auto entries_of_row = [&](Eigen::Index r, Eigen::Index from) {
    return (M.row(r).tail(N - from).array() != 0).count();
  };
  for (Eigen::Index c = 0; c < m; ++c) {
    Eigen::Index shortest = c, fewest = N + 1;
    for (Eigen::Index k = c; k < m; ++k) {
      const Eigen::Index entries = (M.col(k).segment(c, m - c).array() != 0).count();
      if (entries < fewest) shortest = k, fewest = entries;
    }
    if (shortest != c) M.col(c).swap(M.col(shortest));
    Number largest = 0;
    for (Eigen::Index r = c; r < m; ++r) largest = std::max<Number>(largest, abs(M(r, c)));
    Eigen::Index pivot = c;
    fewest = N + 1;
    for (Eigen::Index r = c; r < m; ++r) {
      if (M(r, c) == 0 || abs(M(r, c)) < largest / 8) continue;
      const Eigen::Index entries = entries_of_row(r, c);
      if (entries < fewest) pivot = r, fewest = entries;
    }
    if (pivot != c) M.row(c).swap(M.row(pivot));
    used.clear();
    for (Eigen::Index k = c + 1; k < N; ++k) {
      if (M(c, k) != 0) used.push_back(k);
    }
    for (Eigen::Index r = c + 1; r < N; ++r) {
      if (M(r, c) == 0) continue;
      const Number factor = M(r, c) / M(c, c);
      for (const Eigen::Index k : used) M(r, k) -= factor * M(c, k);
    }
  }
  return M.bottomRightCorner(n, n);
}

template <class Number>
std::vector<ValueOf<Number>> eigenvalues_with(const PerturbationEquations& p) {
  using Dense = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  const Dense A = state_matrix<Number>(p);
  Eigen::EigenSolver<Dense> solver(A, false);
  if (solver.info() != Eigen::Success) solver.compute(A.transpose(), false);
  if (solver.info() != Eigen::Success) return {};
  std::vector<ValueOf<Number>> values;
  for (const auto& v : solver.eigenvalues()) values.push_back({v.real(), v.imag()});
  return values;
}

}  // namespace

std::vector<Value> eigenvalues(const PerturbationEquations& p) { return eigenvalues_with<Real>(p); }
std::vector<FinerValue> finer_eigenvalues(const PerturbationEquations& p) { return eigenvalues_with<Finer>(p); }

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

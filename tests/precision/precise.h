// Eigenvalues of the assembled perturbation equations with 50 digits: the same numbers, none of the product's algebra.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_complex.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <complex>
#include <functional>
#include <random>
#include <vector>

#include "perturbation/perturbation.h"

namespace dynalin::precision {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

// For eigenvalues of which even that leaves nothing: of a block of two that is all but defective rounding takes the
// root.
using Finer = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<110>, boost::multiprecision::et_off>;

struct Value {
  Real re, im;
};

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

// With 50 digits, or with 110 where that leaves nothing. Empty if the QR iteration does not converge, neither for the
// matrix nor for its transpose.
std::vector<Value> eigenvalues(const PerturbationEquations& p);
std::vector<Value> finer_eigenvalues(const PerturbationEquations& p);

// Eigenvalues of the equations with every coefficient somewhere within half a unit of its last digit, as all are that a
// computation has rounded once; those with few digits are exact. In extended precision: the differences to the
// eigenvalues of the coefficients as they stand are some units of double precision and more.
std::vector<Value> eigenvalues_within_rounding(const PerturbationEquations& p, std::mt19937_64& random);

// |λ/2π − given| with the given value in cycles per unit time.
inline Real distance(const Value& exact, const std::complex<double>& hz) {
  static const Real cycle = 2 * boost::math::constants::pi<Real>();
  const Real re = exact.re / cycle - Real(hz.real()), im = exact.im / cycle - Real(hz.imag());
  return sqrt(re * re + im * im);
}

}  // namespace dynalin::precision

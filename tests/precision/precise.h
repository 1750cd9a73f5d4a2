// Eigenvalues of the assembled perturbation equations with 50 digits: the same numbers, none of the product's algebra.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_complex.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "perturbation/perturbation.h"

namespace dynalin::precision {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

// For eigenvalues of which even that leaves nothing. A cluster of k that rounding has spread over 1e-16^(1/k) has
// conditions of about the same inverse: more than 60 of these digits are left.
using Finer = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<110>, boost::multiprecision::et_off>;

template <class Number>
struct ValueOf {
  Number re, im;
};
using Value = ValueOf<Real>;
using FinerValue = ValueOf<Finer>;

// With 50 digits, or with 110 where that leaves nothing. Empty if the QR iteration does not converge, neither for the
// matrix nor for its transpose.
std::vector<Value> eigenvalues(const PerturbationEquations& p);
std::vector<FinerValue> finer_eigenvalues(const PerturbationEquations& p);

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

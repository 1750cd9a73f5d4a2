#include "base/arbitrary_vector.h"

#include <cmath>
#include <complex>
#include <random>

namespace dynalin {

Eigen::VectorXcd arbitrary_vector(Eigen::Index size, unsigned number) {
  std::mt19937_64 generator(number);
  // Of a distribution that is the same everywhere.
  const auto next = [&] { return std::ldexp(static_cast<double>(generator() >> 11), -52) - 1; };
  Eigen::VectorXcd v(size);
  for (std::complex<double>& e : v) {
    const double re = next();
    e = {re, next()};
  }
  return v;
}

}  // namespace dynalin

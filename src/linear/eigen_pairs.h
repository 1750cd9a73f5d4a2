// Computed eigenvalues with right and left vectors, and what is known of their errors.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace dynalin {

// In rad per time: of each complex pair the one with positive imaginary part.
struct EigenPairs {
  std::vector<std::complex<double>> values;
  Eigen::MatrixXcd right, left;  // unit vectors, one column each

  bool real(Eigen::Index i) const { return values[static_cast<std::size_t>(i)].imag() == 0; }
};

struct EigenTrust {
  double bound = 0;      // |error| of the value as corrected [rad/time]
  bool refined = false;  // by inverse iteration
};

// One of the pairs, or the conjugate that belongs to it.
struct Member {
  Eigen::Index at;
  bool conjugate;
};

inline std::complex<double> value(const EigenPairs& pairs, const Member& m) {
  const std::complex<double> v = pairs.values[static_cast<std::size_t>(m.at)];
  return m.conjugate ? std::conj(v) : v;
}

}  // namespace dynalin

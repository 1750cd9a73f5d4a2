// Computed eigenvalues with right and left vectors, and what is known of their errors.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynalin/results.h"
#include "eigenvalues/zero_modes.h"

namespace dynalin {

// In rad per time: of each complex pair the one with positive imaginary part.
struct EigenPairs {
  std::vector<std::complex<double>> values;
  Eigen::MatrixXcd right, left;  // unit vectors, one column each

  bool real(Eigen::Index i) const { return values[static_cast<std::size_t>(i)].imag() == 0; }
};

struct EigenTrust {
  double bound = 0;      // |error| of the value as corrected [rad/time]
  double unknown = 0;    // the part of it that no better computation takes away
  bool refined = false;  // by inverse iteration
  // So many eigenvalues are within the bound that nothing tells apart: the value is their mean.
  Eigen::Index cluster = 1;
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

// A value, or a part of one, that is no more than its bound and than rounding of the model's fastest rate among these,
// or of the other part, is zero as far as anybody can tell; what it was is in the bound then.
void clear_rounding(EigenPairs&, std::vector<EigenTrust>&);

// The vectors of a real value that stands alone are real but for a factor, which goes.
void clear_phases(EigenPairs&, const std::vector<EigenTrust>&);

// Two zeros beside each other may be computed as a conjugate pair, refined down to next to nothing: where a modulus is
// no more than its bound and than the square of double precision of the fastest rate, the pair becomes two real zeros.
// The new one stands last.
void split_pairs_of_zeros(EigenPairs&, std::vector<EigenTrust>&);
// So may equal real values of equal parts, off the axis by rounding: they become real where they have vectors of their
// own. The new ones stand last.
void split_pairs_of_equal_values(EigenPairs&);

// Places of values in the order in which modes are printed: real ones first by ascending modulus, then complex pairs by
// ascending imaginary part.
std::vector<std::size_t> printed_order(const std::vector<std::complex<double>>& values);

// What is said of one of them, and of a zero of the structure; backward errors are still to come.
EigenMode mode_of(const EigenPairs&, const EigenTrust&, std::size_t at);
EigenMode structural_zero_mode(bool defective);

// From [N C; 0 B] to A: vectors of B become unit vectors of A. The part of a right one in the space of the zero modes
// follows from (N − λ) u = −C y.
void map_to_states(const ZeroModes&, EigenPairs&);

}  // namespace dynalin

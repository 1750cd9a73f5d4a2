// How many eigenvalues are inside a closed border, independently of having found them: the winding number of
// det(S − σ E) along it, σ turning to the left.
//
// The determinant is divided by ∏(σ − p) over all places p where an eigenvalue is known or guessed to be. That changes
// the winding number by as many of them as are inside, wherever they are. What is left is divided by exp(polynomial),
// which does not wind at all: the polynomial is fitted to the moduli on the border, and as all that is far away makes a
// function without zeros inside, its phase follows it. So little is left to change from point to point: between two of
// them the logarithm may change by no more than `largest_step`, phase and modulus; where it does, the border is
// divided.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "system/shifted_lu.h"

namespace dynalin {

struct Border {
  std::function<std::complex<double>(double)> at;  // of 0 … 1
  // Only the half above the real axis, from the right end to the left end, of a region that is its own mirror image.
  bool upper_half = false;
  std::vector<double> corners;  // where pieces of it meet, 0 and 1 among them
  std::complex<double> centre;  // of what is inside
  double radius = 1;            // its size
};
Border circle(std::complex<double> centre, double radius);  // its upper half if the centre is real
// left ≤ Re ≤ right, low ≤ Im ≤ high; with low = 0 the upper half of one twice as high.
Border rectangle(double left, double right, double low, double high);

// Nothing if an eigenvalue is too near the border, or it takes more than `most_factorizations`. Where half a border is
// given `known` must hold the mirror image of each value.
std::optional<Eigen::Index> eigenvalues_inside(ShiftedLu&, const Border&,
                                               const std::vector<std::complex<double>>& known,
                                               const std::function<bool(std::complex<double>)>& inside,
                                               std::size_t most_factorizations = 1500, const Progress& = {});

}  // namespace dynalin

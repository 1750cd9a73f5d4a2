// How much of the rigid-body mass each mode carries (MASS_PER_MODE); LINEAR command, 5.1.9.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "modal/modal_distribution.h"

namespace dynalin {

// With r_d the rigid-body displacement along (d = 0 … 2) and about (3 … 5) the axes of a frame and φ_i the displacement
// shape of all bodies: L = φᴴ M r, participation Γ = L/(φᴴ M φ), effective mass |L|²/(φᴴ M φ). Shapes are scaled as in
// the table of coordinates, so that Γ goes with its entries: the largest, of mass centres, rotations and differential
// states, is 1. Those of equal eigenvalues are made orthogonal to each other first, or their masses would count twice.
//
// A mode in which nothing that has mass moves has none of this, nor one whose shape repeats those before it; what is
// left of a sum that cancels is zero.
struct ModalMasses {
  struct Row {
    enum class Kind : std::uint8_t { counted, still, repeated } kind = Kind::counted;
    double generalized = 0;  // φᴴ M φ [mass]
    std::array<std::complex<double>, 6> participation{};
    std::array<double, 6> effective{};  // [mass], [mass·length²]
  };
  std::vector<Row> modes;
  std::array<double, 6> total{};  // of the model as a rigid body
};

// About the origin and axes of `frame`, those of ground if it is not valid.
ModalMasses modal_masses(const System&, const OperatingPoint&, const LinearSystem&, const EigenSolution&,
                         MarkerId frame);

}  // namespace dynalin

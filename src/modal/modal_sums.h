// How the energy of the motion at the operating point is shared among the modes (ENERGY_PER_MODE) and how much of the
// rigid-body mass each mode carries (MASS_PER_MODE); LINEAR command, 5.1.8 and 5.1.9.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "modal/modal_distribution.h"

namespace dynalin {

// With M x″ + C x′ + K x = f in the chosen coordinates x, Φ the displacement shapes and Φ η = x, Φ η′ = x′:
// kinetic ½ η′_iᴴ Σ_j (ΦᴴMΦ)_ij η′_j, potential alike with η and K, dissipated power η′_iᴴ Σ_j (ΦᴴCΦ)_ij η′_j. The
// shares of all modes sum up to the energy of the model.
//
// x′ are the velocities of the operating point, x its displacement from where the linear model would rest,
// K x = −(M x″ + C x′). C and K are the physical matrices (physical_matrices.h), the M of kinetic energy is the mass of
// the bodies seen in x′; forces of differential states are not in them.
struct EnergyPerMode {
  struct Share {
    double kinetic = 0, potential = 0;  // [mass·length²/time²]
    double power = 0;                   // dissipated [mass·length²/time³]
  };
  std::vector<Share> modes;  // of all; one whose shape is a combination of earlier ones has none
  std::vector<bool> counted;
  Share total;
};

// Fails for velocity constraints and where the shapes of all modes do not span the coordinates.
Result<EnergyPerMode> energy_per_mode(const System&, const OperatingPoint&, const LinearSystem&, const EigenSolution&);

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

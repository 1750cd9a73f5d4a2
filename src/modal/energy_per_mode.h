// How the energy of the motion at the operating point is shared among the modes (ENERGY_PER_MODE); LINEAR
// command, 5.1.8.
#pragma once

#include <vector>

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
  bool at_rest = true;  // nothing moves, but for rounding
};

// Fails for velocity constraints and where the shapes of all modes do not span the coordinates.
Result<EnergyPerMode> energy_per_mode(const System&, const OperatingPoint&, const LinearSystem&, const EigenSolution&);

}  // namespace dynalin

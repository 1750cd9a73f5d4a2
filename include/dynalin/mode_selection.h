// Which modes of a linear model are wanted instead of all of them, and what is known of their number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

namespace dynalin {

// A mode is a real eigenvalue or a complex pair. Zeros that follow from the structure of the model come beside those
// that are asked for.
struct NearestModes {
  std::size_t count = 0;
  double frequency = 0;  // of the point on the imaginary axis that they are nearest to [cycles/time]
};
// low ≤ |Im λ|/2π ≤ high and |Re λ| ≤ 2π high [cycles/time].
struct ModesInBand {
  double low = 0, high = 0;
};
using ModeSelection = std::variant<NearestModes, ModesInBand>;

enum class CountedBy : std::uint8_t { nothing, full_solution, inertia, winding_number };

// What a solution for selected modes holds of the region they are in: the band, or around the point of the nearest
// modes the disc that holds all of them and no other.
struct SelectedModes {
  ModeSelection wanted;
  double radius_hz = 0;     // of the disc [cycles/time]
  std::size_t found = 0;    // eigenvalues in the region, conjugates and zeros included
  std::size_t counted = 0;  // the same, independently of having found them
  CountedBy by = CountedBy::nothing;
  // Both agree and bounds tell which modes are in the region: none is missing, and no zero of the structure beside
  // them.
  bool complete = false;
  std::string doubt = {};  // what else speaks against it where both agree, as the end of a sentence
};

}  // namespace dynalin

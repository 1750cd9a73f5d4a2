// The part of the complex plane in which modes are wanted, and where its border may run so that it can be counted what
// is inside.
#pragma once

#include <optional>
#include <vector>

#include "dynalin/mode_selection.h"
#include "selected_modes/eigenvalue_count.h"

namespace dynalin {

// Eigenvalues as far as they are known [rad/time]: of each mode the one with Im ≥ 0.
class KnownModes {
 public:
  // Members of pairs in any number and order, or only one of them, as they were found from a shift.
  KnownModes(const std::vector<std::complex<double>>& values, std::complex<double> shift);

  const std::vector<std::complex<double>>& upper() const { return upper_; }
  std::vector<std::complex<double>> all() const;  // with both members of pairs
  // An eigenvalue found from this shift is real, as far as can be told.
  static bool is_real(std::complex<double> value, std::complex<double> shift);

 private:
  std::vector<std::complex<double>> upper_;
};

struct ModeRegion {
  std::complex<double> centre;
  double radius = 0;                              // of a disc; or
  double low = 0, high = 0, left = 0, right = 0;  // of |Im|, and of Re
  bool is_disc = true;

  bool has(std::complex<double>) const;
  double distance_to_border(std::complex<double>) const;
  Border border() const;
  Eigen::Index count(const KnownModes&) const;  // eigenvalues inside
};

// Distances that differ by less, relative to the eigenvalue, are equal; so are borders to a search.
constexpr double equal_distances = 1e-9;

// A mode belongs to a band if its value within its bound may be inside [cycles/time]. Bounds that are wider than equal
// distances are a doubt of their own, and no wider border.
bool belongs_to(const ModesInBand&, std::complex<double> value, double bound);

// The disc that holds the nearest modes beside `zeros` structural ones, and equally near ones; nothing if the first one
// outside is not among those that are known. `everything` says that there are no others.
std::optional<ModeRegion> disc_of(const NearestModes&, const KnownModes&, Eigen::Index zeros, bool everything);
ModeRegion region_of(const ModesInBand&);
// With a border that keeps off what is known: of a disc between the last mode inside and the first outside, of a band
// a little outside. `attempt` counts from 0.
ModeRegion countable(const ModeRegion&, const KnownModes&, int attempt);

}  // namespace dynalin

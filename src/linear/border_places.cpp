#include "linear/border_places.h"

#include <algorithm>

namespace dynalin {

std::vector<std::complex<double>> beside_border(const ModeRegion& region, std::vector<std::complex<double>> known,
                                                ShiftInverse& op, ModeSearch& search) {
  using Complex = std::complex<double>;
  constexpr std::size_t most_looks = 3;
  constexpr Eigen::Index nearest = 12;
  constexpr double the_same = 0.01;  // of the distance from where it is looked at
  std::erase_if(known, [](Complex v) { return v.imag() < 0; });
  std::ranges::sort(known, {}, [&](Complex v) { return region.distance_to_border(v); });
  std::vector<Complex> looked_from, found;
  double seen = 0;  // how far the looks have reached
  for (const Complex& v : known) {
    if (looked_from.size() == most_looks) break;
    const Complex from = region.nearest_on_border(v);
    if (std::ranges::any_of(looked_from, [&](Complex p) { return std::abs(p - from) <= seen; })) continue;
    looked_from.push_back(from);
    if (!op.move_to(from)) continue;
    for (const Complex& value : search.glance(nearest)) {
      const double away = std::abs(value - from);
      const bool is_known = std::ranges::any_of(known, [&](Complex k) {
        return std::min(std::abs(k - value), std::abs(std::conj(k) - value)) <= the_same * away;
      });
      seen = std::max(seen, away);
      if (!is_known) found.push_back(value);
    }
  }
  return KnownModes(found).all();
}

}  // namespace dynalin

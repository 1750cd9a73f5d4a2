#include "selected_modes/selection_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/cycle.h"

namespace dynalin {

namespace {

// Whether bounds tell those that are in the disc from the next ones, half of the way to which is the border.
bool nearest_are_known(const std::vector<EigenMode>& modes, const SelectionSeen& seen) {
  const ModeRegion& disc = seen.region;
  if (!disc.is_disc || disc.radius == 0 || seen.everything) return true;
  return std::ranges::all_of(modes, [&](const EigenMode& m) {
    const double inside = disc.radius - std::abs(cycle * m.eigenvalue_hz - disc.centre);
    return m.structural_zero || cycle * m.error_bound_hz <= inside;
  });
}

}  // namespace

bool may_be_beyond_band(const ModesInBand& band, const std::vector<EigenMode>& modes) {
  return std::ranges::any_of(modes, [&](const EigenMode& m) {
    const double re = std::abs(m.eigenvalue_hz.real()), im = std::abs(m.eigenvalue_hz.imag());
    const double bound = m.error_bound_hz;
    if (m.structural_zero || !(bound > equal_distances * std::abs(m.eigenvalue_hz))) return false;
    const auto crosses = [&](double value, double border) { return std::abs(value - border) <= bound; };
    const bool is_near = re <= band.high + bound && im <= band.high + bound && im >= band.low - bound;
    return is_near && (crosses(re, band.high) || crosses(im, band.high) || (band.low > 0 && crosses(im, band.low)));
  });
}

std::string doubt_of(const std::vector<EigenMode>& modes, const ModeSelection& wanted, const SelectionSeen& seen) {
  const ModeRegion& region = seen.region;
  const double extent = (region.is_disc ? region.radius : std::max(region.right, region.high)) / cycle;
  const auto* nearest = std::get_if<NearestModes>(&wanted);
  Eigen::Index eigenvalues = 0;
  std::size_t listed = 0;
  for (const EigenMode& m : modes) {
    eigenvalues += m.is_real ? 1 : 2;
    if (m.structural_zero) continue;
    ++listed;
    if (!std::isfinite(m.error_bound_hz)) return "one has no error bound";
    // A value that may be anywhere in the region, or outside of it, is not known to be one of those that are wanted.
    if (!(m.error_bound_hz < std::max(extent, std::abs(m.eigenvalue_hz))))
      return fmt::format("the error bound of one, {:.2g} cycles per unit time, is as large as the region",
                         m.error_bound_hz);
    const auto surely = [&](double of_region) {
      return m.error_bound_hz < std::max(of_region * extent, std::abs(m.eigenvalue_hz));
    };
    if (!surely(1e-4)) return "some cannot be told from zeros that follow from the structure";
    // Two of them are two of the modes that are asked for, or one, unless they are zeros for every purpose.
    if (nearest && m.is_real && m.cluster_size > 1 && !surely(1e-6)) return "real values near zero may be slow pairs";
  }
  if (!seen.all_zeros) return "whether there are more zeros that follow from the structure is not known";
  if (nearest && listed < nearest->count && eigenvalues < seen.states)
    return fmt::format("the model has others besides these {} and the zeros that follow from its structure", listed);
  if (!nearest_are_known(modes, seen)) return "bounds do not tell which are the nearest";
  if (!nearest && may_be_beyond_band(std::get<ModesInBand>(wanted), modes)) return beyond_band;
  return {};
}

}  // namespace dynalin

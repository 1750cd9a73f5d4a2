#include "selected_modes/selection_of_modes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/cycle.h"
#include "selected_modes/selection_doubts.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;

struct Region {
  Complex centre;
  double radius = 0;                  // of a disc
  const ModesInBand* band = nullptr;  // instead of it

  bool has(Complex hz, double bound) const {
    return band ? belongs_to(*band, hz, bound) : std::abs(hz - centre) <= radius;
  }
};

// Of the disc that holds the nearest modes and no other: halfway to the next one.
double radius_of(const std::vector<EigenMode>& modes, Complex centre, std::size_t count) {
  std::vector<std::pair<double, double>> distances;  // and what makes no difference, or is not known of them
  for (const EigenMode& m : modes) {
    if (m.structural_zero) continue;
    const double same = equal_distances * std::max(std::abs(m.eigenvalue_hz), std::abs(centre));
    distances.emplace_back(std::abs(m.eigenvalue_hz - centre),
                           std::isfinite(m.error_bound_hz) ? std::max(same, m.error_bound_hz) : same);
  }
  if (distances.empty() || count == 0) return 0;
  std::sort(distances.begin(), distances.end());
  std::size_t last = std::min(count, distances.size()) - 1;
  while (last + 1 < distances.size() &&
         distances[last + 1].first <=
             distances[last].first + std::max(distances[last].second, distances[last + 1].second))
    ++last;
  const double inside = distances[last].first;
  return last + 1 < distances.size() ? (inside + distances[last + 1].first) / 2 : 2 * inside;
}

}  // namespace

EigenSolution selected_of(const EigenSolution& all, const ModeSelection& wanted) {
  Region region;
  if (const auto* nearest = std::get_if<NearestModes>(&wanted)) {
    region.centre = {0, nearest->frequency};
    region.radius = radius_of(all.modes, region.centre, nearest->count);
  } else {
    region.band = &std::get<ModesInBand>(wanted);
  }
  SelectedModes selected{.wanted = wanted, .radius_hz = region.radius, .by = CountedBy::full_solution};
  std::vector<Eigen::Index> chosen;
  EigenSolution out;
  for (std::size_t k = 0; k < all.modes.size(); ++k) {
    const EigenMode& m = all.modes[k];
    const bool inside = region.has(m.eigenvalue_hz, m.error_bound_hz);
    selected.found += inside;
    if (!m.is_real) selected.found += region.has(std::conj(m.eigenvalue_hz), m.error_bound_hz);
    if (!inside && !m.structural_zero) continue;
    chosen.push_back(static_cast<Eigen::Index>(k));
    out.modes.push_back(m);
  }
  selected.counted = selected.found;
  ModeRegion seen = region.band ? region_of(*region.band) : ModeRegion{};
  if (!region.band) seen.centre = cycle * region.centre, seen.radius = cycle * region.radius;
  selected.doubt = doubt_of(out.modes, wanted, {seen, static_cast<Eigen::Index>(all.states.size()), true, true});
  if (selected.doubt.empty() && region.band && may_be_beyond_band(*region.band, all.modes))
    selected.doubt = beyond_band;
  selected.complete = selected.doubt.empty();

  out.time = all.time;
  out.rm = all.rm, out.pstate = all.pstate;
  out.without_damping = all.without_damping, out.original = all.original;
  out.kinematic_states = all.kinematic_states, out.differential_states = all.differential_states;
  out.states = all.states;
  out.of_equations = all.of_equations;
  out.selected = std::move(selected);
  if (all.vectors.size() > 0) out.vectors = all.vectors(Eigen::all, chosen);
  out.shape_labels = all.shape_labels;
  if (all.shapes.size() > 0) out.shapes = all.shapes(Eigen::all, chosen);
  return out;
}

std::size_t modes_in(const EigenSolution& solution) {
  return static_cast<std::size_t>(std::ranges::count(solution.modes, false, &EigenMode::structural_zero));
}

EigenSolution without_farther_ones(EigenSolution selected) {
  const auto* nearest = std::get_if<NearestModes>(&selected.selected->wanted);
  if (!nearest || modes_in(selected) <= nearest->count) return selected;
  EigenSolution fewer = selected_of(selected, selected.selected->wanted);
  if (fewer.modes.size() == selected.modes.size()) return selected;
  fewer.selected->by = selected.selected->by;
  return fewer;
}

}  // namespace dynalin

#include "cautions/stiction_caution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/clearly_larger.h"
#include "mechanics/stiction_source.h"
#include "modal/modal_distribution.h"
#include "system/sources.h"

namespace dynalin {

namespace {

// The mode that deforms the bristles most, by their energy ½ Σ k |z|² as a share of the kinetic energy; the same share
// within rounding belongs to the mode that is listed first.
struct Held {
  std::size_t mode = 0;
  double share = 0;
};
std::optional<Held> most_held(const Stiction& s, const ElementLabel& friction, const LinearSystem& linear,
                              const EigenSolution& modes, const ModalDistribution& energies) {
  if (modes.vectors.cols() != static_cast<Eigen::Index>(modes.modes.size())) return std::nullopt;
  constexpr double least_part_of_energy = 1e-9;  // of the kinetic energy
  std::optional<Held> most;
  for (std::size_t mode = 0; mode < modes.modes.size(); ++mode) {
    if (modes.modes[mode].structural_zero) continue;
    const auto v = modes.vectors.col(static_cast<Eigen::Index>(mode));
    const double largest = v.cwiseAbs().maxCoeff(), kinetic = energies.header(mode).kinetic_energy;
    if (!(largest > 0) || !(kinetic > 0)) continue;
    double energy = 0;
    for (std::size_t k = 0; k < linear.model.states.size(); ++k) {
      const StateLabel& state = linear.model.states[k];
      if (state.owner != friction.element()) continue;
      const auto direction = static_cast<std::size_t>(state.coordinate - 1);
      energy += 0.5 * s.stiffness.at(direction) * std::norm(v(static_cast<Eigen::Index>(k)) / largest);
    }
    const double share = energy / kinetic;
    if (most ? is_clearly_larger(share, most->share, equal_solutions) : share > least_part_of_energy)
      most = {mode, share};
  }
  return most;
}

}  // namespace

void stiction_cautions(const System& system, const OperatingPoint& op, const LinearSystem& linear,
                       const EigenSolution& modes, Diagnostics& out) {
  const Motion motion = system.motion(op);
  std::optional<ModalDistribution> energies;
  for_each_source<StictionSource>(system, [&](const ElementSet& elements, const StictionSource& source) {
    std::vector<Stiction> sticking;
    source.sticking(motion, sticking);
    for (const Stiction& s : sticking) {
      const ElementLabel& friction = elements.labels[s.element];
      if (!energies) energies.emplace(system, linear, modes);
      const auto held = most_held(s, friction, linear, modes, *energies);
      std::string mode;
      if (held) {
        mode = fmt::format(", most of all in mode {} of {:.5g} {}", held->mode + 1,
                           std::abs(modes.modes[held->mode].eigenvalue_hz), system.model().units.frequency());
      }
      out.warning("joint-in-stiction", friction.at,
                  fmt::format("{} is in stiction: the stiffness of {} may be spurious, and with it modes{}", s.joint,
                              friction.full_text(), mode),
                  "EFFECT=SLIDING has no such stiffness");
    }
  });
}

}  // namespace dynalin

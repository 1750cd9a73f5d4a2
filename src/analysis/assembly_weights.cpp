#include "analysis/assembly_weights.h"

#include <array>

#include "analysis/outside_weight.h"

namespace dynalin {

namespace {

constexpr double exact_weight = 1e8;  // of coordinates that EXACT asks to keep

// The turns, of unit size, that change one of the angles ψ, θ and φ alone of Rz(ψ) Rx(θ) Rz(φ) most for their size.
// Where z is vertical ψ and φ are one angle.
std::array<Vector, 3> turns_of_angles(const Matrix3& R) {
  constexpr double least_sine_from_vertical = 1e-6;
  const Vector up{0, 0, 1}, nodes = cross(up, R.z);
  const double sine = norm(nodes);
  if (sine <= least_sine_from_vertical) return {up, R.x, up};
  const Vector line = nodes / sine, by_psi = cross(line, R.z), by_phi = cross(line, up);
  return {by_psi / norm(by_psi), line, by_phi / norm(by_phi)};
}

// A beam follows as a whole where one of its nodes has to move: alone it would go past its neighbour, and fold the
// element between them over. Over all of its nodes the way between neighbours counts as much as the way itself.
void couple_neighbours(const Layout& layout, AssemblyWeights& weights) {
  for (const TurningWhole& whole : layout.turning_wholes) {
    const auto count = static_cast<double>(whole.bodies.size());
    for (std::size_t b = 1; b < whole.bodies.size(); ++b) {
      const std::int32_t one = layout.body(whole.bodies[b - 1]).offset, other = layout.body(whole.bodies[b]).offset;
      for (std::int32_t k = 0; k < 3; ++k) {
        const double weight = count * count * weights.of_coordinates[static_cast<std::size_t>(one + k)];
        weights.coupled.insert(weights.coupled.end(), {{one + k, one + k, weight},
                                                       {other + k, other + k, weight},
                                                       {one + k, other + k, -weight},
                                                       {other + k, one + k, -weight}});
      }
    }
  }
}

}  // namespace

AssemblyWeights assembly_weights(const System& system, const OperatingPoint& drawn) {
  AssemblyWeights weights;
  std::vector<double>& weight = weights.of_coordinates;
  weight.resize(system.coordinates());
  for (std::size_t k = 0; k < weight.size(); ++k) {
    const double s = system.coordinate_scale(static_cast<std::int32_t>(k));
    weight[k] = 1.0 / (s * s);
  }
  const Layout& layout = system.layout();
  couple_neighbours(layout, weights);
  for (const ExtraBlock& e : layout.extras) {
    for (std::int32_t k = 0; k < e.count; ++k) weight[static_cast<std::size_t>(e.offset + k)] *= outside_weight(e);
  }
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const BodyBlock& block = layout.bodies[b];
    const std::array<bool, 6>& exact = system.model().bodies[b].exact;
    const bool all_angles = exact[3] && exact[4] && exact[5];
    for (std::int32_t k = 0; k < block.count; ++k) {
      if (k < 3 ? exact[static_cast<std::size_t>(k)] : all_angles)
        weight[static_cast<std::size_t>(block.offset + k)] *= exact_weight;
    }
    if (all_angles || !block.turns()) continue;
    const auto turns = turns_of_angles(drawn.poses[b].R);
    for (std::size_t angle = 0; angle < 3; ++angle) {
      if (!exact[3 + angle]) continue;
      for (std::int32_t r = 0; r < 3; ++r) {
        for (std::int32_t c = 0; c < 3; ++c) {
          const double product = turns[angle][static_cast<std::size_t>(r)] * turns[angle][static_cast<std::size_t>(c)];
          weights.coupled.push_back({block.offset + 3 + r, block.offset + 3 + c, exact_weight * product});
        }
      }
    }
  }
  return weights;
}

}  // namespace dynalin

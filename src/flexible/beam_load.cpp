#include "flexible/beam_load.h"

#include "flexible/beam_points.h"

namespace dynalin {

using beam::cubic_at, beam::cubics, beam::four_places, beam::four_weights, beam::spin_place, beam::Turning,
    beam::values, beam::varied;

double beam_load_place(std::size_t point) { return 0.5 * (1 + four_places[point]); }

void BeamLoadPoint::add(const Vector& force, const Vector& moment, BeamVector& out) const {
  for (std::size_t a = 0; a < line.size(); ++a) {
    for (std::size_t k = 0; k < 3; ++k) out(cubic_at[a] + static_cast<Eigen::Index>(k)) += line[a] * force[k];
  }
  for (std::size_t i = 0; i < rotation_seeds; ++i) out(spin_place(i)) += dot(turning[i], moment);
}

std::array<BeamLoadPoint, beam_load_points> beam_load_points_of(const BeamElement& e, const BeamMotion& m,
                                                                bool with_moments) {
  std::array<BeamLoadPoint, beam_load_points> points;
  for (std::size_t g = 0; g < beam_load_points; ++g) {
    const double weight = 0.5 * e.length() * four_weights[g];
    points[g].line = cubics(four_places[g], e.length());
    for (double& h : points[g].line) h *= weight;
  }
  if (!with_moments) return points;
  const RotationField<double> field(values(m.axes[0]), values(m.axes[1]), values(m.middle));
  for (std::size_t g = 0; g < beam_load_points; ++g) {
    const double weight = 0.5 * e.length() * four_weights[g];
    const SectionRotation<double> section(field, four_places[g], e.length());
    for (std::size_t i = 0; i < rotation_seeds; ++i) points[g].turning[i] = weight * section.spin[i];
  }
  return points;
}

BeamMatrix beam_moments_by_position(const BeamElement& e, const BeamMotion& m,
                                    const std::array<Vector, beam_load_points>& moments) {
  BeamMatrix out = BeamMatrix::Zero();
  const RotationField<Turning> field = varied(m);
  for (std::size_t g = 0; g < beam_load_points; ++g) {
    const SectionRotation<Turning> section(field, four_places[g], e.length());
    const Vector moment = (0.5 * e.length() * four_weights[g]) * moments[g];
    for (std::size_t i = 0; i < rotation_seeds; ++i) {
      const Turning work = dot(section.spin[i], moment);
      for (std::size_t k = 0; k < rotation_seeds; ++k) out(spin_place(i), spin_place(k)) += work.partial[k];
    }
  }
  return out;
}

}  // namespace dynalin

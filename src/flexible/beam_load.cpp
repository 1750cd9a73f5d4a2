#include "flexible/beam_load.h"

#include "flexible/beam_points.h"

namespace dynalin {

using beam::cubic_at, beam::cubics, beam::four_places, beam::four_weights;

namespace {
double weight_of(std::size_t point, const BeamElement& e) { return 0.5 * e.length() * four_weights[point]; }
}  // namespace

double beam_load_place(std::size_t point) { return 0.5 * (1 + four_places[point]); }

BeamLinePoint beam_line_at(std::size_t point, const BeamElement& e) {
  BeamLinePoint p{cubics(four_places[point], e.length()), {}};
  for (std::size_t a = 0; a < p.at.size(); ++a) p.at[a] = static_cast<std::size_t>(cubic_at[a]);
  return p;
}

void BeamLoadPoint::add(const Vector& force, const Vector& moment, BeamVector& out) const {
  for (std::size_t a = 0; a < line.size(); ++a) {
    for (std::size_t k = 0; k < 3; ++k) out(cubic_at[a] + static_cast<Eigen::Index>(k)) += line[a] * force[k];
  }
  for (std::size_t i = 0; i < turning.size(); ++i) out(static_cast<Eigen::Index>(i)) += dot(turning[i], moment);
}

std::array<BeamLoadPoint, beam_load_points> beam_load_points_of(const BeamElement& e, const BeamMotion& m,
                                                                bool with_moments) {
  std::array<BeamLoadPoint, beam_load_points> points;
  for (std::size_t g = 0; g < beam_load_points; ++g) {
    points[g].line = cubics(four_places[g], e.length());
    for (double& h : points[g].line) h *= weight_of(g, e);
  }
  if (!with_moments) return points;
  const BeamElement::Spins spins = e.spins(m);
  for (std::size_t g = 0; g < beam_load_points; ++g) {
    for (std::size_t i = 0; i < beam_coordinates; ++i) points[g].turning[i] = weight_of(g, e) * spins[g][i];
  }
  return points;
}

BeamMatrix beam_moments_by_position(const BeamElement& e, const BeamMotion& m,
                                    const std::array<Vector, beam_load_points>& moments) {
  BeamElement::Moments weighed;
  for (std::size_t g = 0; g < beam_load_points; ++g) weighed[g] = weight_of(g, e) * moments[g];
  return e.moments_by_position(m, weighed);
}

}  // namespace dynalin

// What loads along an element of a beam do to its coordinates.
//
// A force f and a moment m per undeformed length, global axes, work on the cubic r and on the spin w of the section,
//
//     δW = ∫ f·δr + m·w dS ≈ Σ_g W_g (f·δr + m·w)_g
//
// over four Gauss points g: what weight and inertia of the cubic take, so that a load ρA g is the weight.
#pragma once

#include "flexible/beam_element.h"

namespace dynalin {

// Where a load point lies along the undeformed element, from 0 to 1.
double beam_load_place(std::size_t point);

// The line there is Σ factor (r₁, r_s1, r₂, r_s2), each axis alike; `at` is where x of each stands among the
// coordinates.
struct BeamLinePoint {
  std::array<double, 4> factor;
  std::array<std::size_t, 4> at;
};
BeamLinePoint beam_line_at(std::size_t point, const BeamElement&);

// δr and w there by the coordinates of the element, times W_g.
struct BeamLoadPoint {
  std::array<double, 4> line{};                    // r₁, r_s1, r₂, r_s2, each axis alike
  std::array<Vector, beam_coordinates> turning{};  // by each coordinate

  // Adds the loads of a force and a moment by length on the coordinates.
  void add(const Vector& force, const Vector& moment, BeamVector&) const;
};

// `with_moments`: with the turning, which forces do not need.
std::array<BeamLoadPoint, beam_load_points> beam_load_points_of(const BeamElement&, const BeamMotion&,
                                                                bool with_moments);

// How the loads of moments by length, that keep their global components, change with the coordinates.
BeamMatrix beam_moments_by_position(const BeamElement&, const BeamMotion&,
                                    const std::array<Vector, beam_load_points>& moments);

}  // namespace dynalin

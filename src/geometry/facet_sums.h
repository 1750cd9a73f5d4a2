// What parts of facets in a solid add up to, whatever the solid is: integrals over the facets, and how all changes as
// the surface of the solid sweeps over them, along the arcs in which they cut it.
#pragma once

#include "geometry/facet_integrals.h"

namespace dynalin {

// All in the axes of the solid, from `origin`. As it moves by d + w × x, an integral grows by by_shift d + by_turn w.
class FacetSums {
 public:
  Overlap overlap;
  Overlap::Part curved;  // of the solid's own surface, without its ends
  Vector origin{};

 protected:
  // What of a facet there is, while it is added up.
  struct Facet {
    Vector normal, start;  // start: a place of it, from the origin
    PlaneMoments moments;
    Overlap::FixedPart part;
  };

  // Piece: a graph over its chord, with places on it (conic_arc.h, spiric_arc.h).
  template <class Solid, class Piece>
  void add_arc(const Solid& solid, const Piece& p, Facet& facet) {
    const double length = norm(p.way);
    p.for_each_place([&](const auto& at) {
      const double width = length * at.share;
      facet.moments.add_strip(at.on_chord - origin, p.across, at.height, width);
      // The arc moves over the facet, and the facet over the curved surface.
      const Vector slope = solid.gradient(at.at), over = slope * (width / at.rise), place = at.at - origin;
      const Vector turned = cross(place, over);
      Overlap::FixedPart& part = facet.part;
      part.area_by_shift += over, part.area_by_turn += turned;
      part.first_by_shift += outer(place, over), part.first_by_turn += outer(place, turned);
      const Vector back = facet.normal * (norm(slope) * width / at.rise);
      curved.area_by_shift -= back, curved.area_by_turn -= cross(place, back);
    });
  }

  // The surface of the solid sweeps over what facets do not bound: what moves in is what goes out through the facets.
  void add(Facet& facet) {
    const Vector& n = facet.normal;
    const PlaneMoments& m = facet.moments;
    facet.part.area = m.area, facet.part.first = m.first;
    overlap.of_J.push_back(facet.part);

    const double h = dot(n, facet.start);
    net_ += n * m.area, height_ += h * m.area, height_moment_ += m.first * h, along_ += m.first * n.z;
    overlap.volume_by_shift -= n * m.area;
    overlap.volume_by_turn -= cross(m.first, n);
    overlap.moment_by_shift -= outer(m.first, n);
    const auto crossed = [&](const Vector& row) { return cross(row, n); };
    overlap.moment_by_turn -= transpose(Matrix3{crossed(m.second.x), crossed(m.second.y), crossed(m.second.z)});
  }
  // What the volume holds moves with it.
  void carry_along() {
    overlap.moment_by_shift += overlap.volume * Matrix3::identity();
    overlap.moment_by_turn -= skew(overlap.moment);
  }

  Vector net_{};                      // ∫ n dS of the facets
  double height_ = 0;                 // ∫ n · x dS
  Vector height_moment_{}, along_{};  // ∫ (n · x) x dS, ∫ n_z x dS
};

// What is known but for multiples of `whole`, and is between nothing and all: next to either `is_most` says which.
inline double between_none_and(double whole, double value, bool is_most) {
  constexpr double near_whole = 1e-7;  // of it
  const double rest = value - whole * std::floor(value / whole);
  if (is_most && rest < near_whole * whole) return rest + whole;
  if (!is_most && rest > (1 - near_whole) * whole) return rest - whole;
  return rest;
}

}  // namespace dynalin

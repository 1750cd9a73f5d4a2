// What parts of facets in a solid say of a volume that both have in common: integrals over the facets and, along the
// lines in which they cut the solid, over its own surface. What is around its surface is known but for whole turns: a
// volume that holds a pole of the surface has one.
#pragma once

#include <array>
#include <vector>

#include "geometry/conic_arc.h"
#include "geometry/facet_section.h"
#include "geometry/facet_sums.h"

namespace dynalin {

class SolidSums : public FacetSums {
 public:
  explicit SolidSums(const QuadricSolid& solid) : solid_(solid) {}

  // A facet, with all pieces of its arcs.
  void add(const FacetSection&, const std::vector<ConicPiece>&);
  // To volume, moment, their changes and the areas of the solid's surface. Poles: points of the lower and of the upper
  // rim, or any of an ellipsoid (upper). False where what was added up is the surface of nothing.
  bool finish(bool holds_lower_pole, bool holds_upper_pole);

  Overlap::Part low, high;  // of the solid's own surface: its ends

 private:
  struct End {
    double turn = 0, area = 0;  // along what cuts it
    Vector first{}, way{};
  };
  void add_end(bool upper, const FacetSection::Piece&, const Vector& normal, Overlap::FixedPart&);
  void add_to_mantle(const ConicPiece&);
  void keep_on_sphere(const ConicPiece&, const Vector& normal);
  double angle_on_sphere(const Vector& apex) const;
  bool finish_frustum(bool lower, bool upper);
  bool finish_ellipsoid(bool holds_pole);

  const QuadricSolid& solid_;
  double base_ = 0;  // height on the axis
  std::vector<ConicPiece> on_mantle_;
  double turn_ = 0, area_ = 0;
  Vector first_{};
  std::array<End, 2> ends_;
  struct SphereArc {
    Vector from, to, across;
  };
  std::vector<SphereArc> on_sphere_;
};

}  // namespace dynalin

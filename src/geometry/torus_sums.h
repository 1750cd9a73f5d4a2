// What parts of facets in a torus say of a volume that both have in common, as solid_sums.h does of other solids. Over
// the torus' own surface, of which the angle u about the axis and the angle v in the tube are coordinates, integrals
// are those along the lines in which facets cut it. They are known but for the whole surface, whichever way the lines
// go around the axis or the tube. All is measured from a place on one of the lines, so that nothing is large that
// cancels where the volume is small.
#pragma once

#include <vector>

#include "geometry/facet_sums.h"
#include "geometry/torus_section.h"

namespace dynalin {

class TorusSums : public FacetSums {
 public:
  explicit TorusSums(const TorusSolid& torus) : torus_(torus) {}

  // A facet, which stays where it is until all is finished.
  void add(const TorusSection&);
  // To volume, moment, their changes and the area of the torus' surface. `holds_most`: of that, where what was added up
  // leaves open whether it is all or nothing. False where what was added up is the surface of nothing.
  bool finish(bool holds_most);

 private:
  struct OverSurface;
  struct Angles {
    double u, v;
  };
  void set_origin(const Vector&);
  Angles angles(const Vector& p) const;  // from those of the origin
  void add_chain(const TorusSection::Chain&, OverSurface&) const;

  const TorusSolid& torus_;
  std::vector<const TorusSection*> sections_;
  // Of the origin.
  double radius_ = 0, cos_u_ = 1, sin_u_ = 0, v_ = 0, cos_v_ = 1, sin_v_ = 0;
};

}  // namespace dynalin

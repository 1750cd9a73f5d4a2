// What a solid and a body of facets have in common: each volume that hangs together, with its integrals and how they
// change as the solid moves. The surface of a volume is the part of the facets that is in the solid and the part of the
// solid's surface that is in the body; where lines in which they cut bound the same part of the latter is found along
// meridians of it.
#pragma once

#include <vector>

#include "geometry/facet_overlap.h"
#include "geometry/quadric_solid.h"
#include "geometry/torus_solid.h"

namespace dynalin {

// The solid is I. Of its surface: the curved one, and both ends where it has any.
struct SolidOverlap : Overlap {
  Part curved, low, high;
};

struct SolidOverlaps {
  std::vector<SolidOverlap> volumes;
  Vector aside{};         // see Overlaps
  bool engulfed = false;  // the solid, or a part of the body, is wholly in the other
  bool definite = true;   // false: roundings leave open where surfaces cross
};

// `cavity`: J is what is around its facets instead of in them.
SolidOverlaps find_overlaps(const QuadricSolid& I, const RelativeFrame<double>& I_from_J, const FacetBody& J,
                            bool cavity);
SolidOverlaps find_overlaps(const TorusSolid& I, const RelativeFrame<double>& I_from_J, const FacetBody& J,
                            bool cavity);
// Between surfaces that do not cross, at least. [length]
double least_distance(const QuadricSolid& I, const RelativeFrame<double>& I_from_J, const FacetBody& J);
double least_distance(const TorusSolid& I, const RelativeFrame<double>& I_from_J, const FacetBody& J);

}  // namespace dynalin

// The part of a facet that is in a solid: both are convex, and so it is one piece, bounded by parts of its own sides,
// of lines in which it cuts the ends of the solid, and of arcs in which it cuts the curved surface.
#pragma once

#include <vector>

#include "geometry/facet_arrangement.h"
#include "geometry/quadric_solid.h"

namespace dynalin {

struct FacetSection {
  // With the part to its left, as seen from outside of what is full.
  struct Piece {
    SolidFace face = SolidFace::none;  // of the solid, that cuts here; none: a side of the facet
    std::size_t side = 0;
    Vector from, to;
    Vector direction;                             // of the chord, also where both ends are one
    bool from_corner = false, to_corner = false;  // of a side: there it goes on around the facet
  };
  FacetBody::Index triangle;
  Vector normal;
  std::vector<Piece> boundary;
  bool consistent = true;
};

// Empty of a facet that is beside the solid. The surface stands in the axes of the solid.
FacetSection section_of(const QuadricSolid&, const PlacedSurface&, FacetBody::Index triangle);

}  // namespace dynalin

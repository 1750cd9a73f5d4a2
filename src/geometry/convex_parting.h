// The direction in which two convex bodies of flat faces part soonest: across a face of either, or across an edge of
// each.
#pragma once

#include <optional>

#include "geometry/convex_body.h"
#include "mechanics/path.h"

namespace dynalin {

struct ConvexParting {
  double overlap = 0;    // along it, negative where they are apart
  bool definite = true;  // no other direction is as near
  // What it is across: a face of J, one of I, or one of both that part as soon; or else an edge of both.
  std::optional<ConvexBody::Index> face_of_I, face_of_J;
  ConvexBody::Index edge_of_I = 0, edge_of_J = 0;
  // The corners that are deepest across these faces: of J in that of I, of I in that of J.
  ConvexBody::Index deepest_of_I = 0, deepest_of_J = 0;
};

// I stands in the axes of J.
ConvexParting convex_parting(const ConvexBody& I, const RelativeFrame<double>& I_from_J, const ConvexBody& J);

}  // namespace dynalin

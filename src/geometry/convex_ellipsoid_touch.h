// An ellipsoid and a convex body of flat faces, by the law of ellipsoid_touch.h: the best direction is the normal of a
// face, or lies between those of the two faces at an edge, or of all at a corner. Of a body with many of them few are
// looked at: faces say how far apart both are at least, and one point of the ellipsoid how far they can be about an
// edge or a corner.
#pragma once

#include "geometry/convex_body.h"
#include "geometry/touch.h"

namespace dynalin {

template <class T>
Touch<T> touch_ellipsoid(const solid::Ellipsoid&, const RelativeFrame<T>& from_body, const ConvexBody&);

}  // namespace dynalin

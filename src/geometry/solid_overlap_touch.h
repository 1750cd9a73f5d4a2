// Where a cylinder, a frustum, an ellipsoid or a torus overlaps a body of facets that is not convex, or stands in a
// cavity of facets: as two bodies of facets do (overlap_touch.h), a place in each volume that both have in common. Of
// the solid's own faces, ends are flat; its curved surface is one face, by its mean normal.
#pragma once

#include <span>

#include "geometry/quadric_solid.h"
#include "geometry/torus_solid.h"
#include "geometry/touch.h"

namespace dynalin {

template <class T>
void touch_overlaps(const QuadricSolid& I, const RelativeFrame<T>& I_from_J, const FacetBody& J, bool cavity,
                    std::span<Touch<T>>);
template <class T>
void touch_overlaps(const TorusSolid& I, const RelativeFrame<T>& I_from_J, const FacetBody& J, bool cavity,
                    std::span<Touch<T>>);

}  // namespace dynalin

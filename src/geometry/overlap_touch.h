// Where two bodies of facets overlap of which one is not convex, or one is a cavity: a place in each volume that both
// have in common, at its centroid, with the normal across which it grows most as the bodies come nearer.
#pragma once

#include <span>

#include "geometry/touch.h"

namespace dynalin {

inline constexpr std::size_t most_overlaps = 64;  // of more volumes the last one is not defined

template <class T>
void touch_overlaps(const FacetBody& I, const RelativeFrame<T>& I_from_J, const FacetBody& J, bool cavity,
                    std::span<Touch<T>>);

// The same as a box, of which contacts in closed form know more.
FacetBody facets_of_box(const Vector& low, const Vector& high);

}  // namespace dynalin

// Where two convex bodies of flat faces overlap, as boxes do (box_touch.h): all places have the normal along which the
// bodies part soonest; seen along it they are the corners of the side of either that looks at the other, where they are
// in the other one's side, and the crossings of the outlines of both sides.
#pragma once

#include "geometry/convex_body.h"
#include "geometry/touch.h"

namespace dynalin {

// How many places two of them may have; of more the last one is not defined.
std::size_t convex_touches(std::size_t corners_of_I, std::size_t corners_of_J);

template <class T>
void touch_convex(const ConvexBody& I, const RelativeFrame<T>& I_from_J, const ConvexBody& J, std::span<Touch<T>>);

}  // namespace dynalin

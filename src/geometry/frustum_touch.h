// Where a frustum overlaps a box or another frustum: the deepest place along the direction in which they part soonest,
// and with it all that the faces and lines that look in this direction have in common, each place with the normal of
// its own two features.
#pragma once

#include "geometry/convex_body.h"
#include "geometry/touch.h"

namespace dynalin {

// Of a box: both rims in its face, four edges across the mantle, four corners in an end of the frustum and each of four
// edges twice over its rim, the ends of a line that is parallel to an edge, and one of none of these.
inline constexpr std::size_t frustum_box_touches = 23;
// Of two: each way both rims in an end and a line of the mantle twice over its rim, two lines that cross, the ends of
// parallel ones, and one of none of these.
inline constexpr std::size_t frustum_touches = 14;
// As with a box whose faces have as many corners as the face that has most, and all corners and edges beside it, or
// some hundreds of them; of more the last one is not defined.
std::size_t frustum_flat_touches(const ConvexBody&);
// Whether it has corners that a mantle passes over in a jump: of facets that go on from each to the next in bends of
// less than 45 degrees, such as those of a dome. Then a motion does not keep its energy.
bool jumps_at_corners(const ConvexBody&);

template <class T>
void touch_frustum(const solid::Frustum& I, const RelativeFrame<T>& I_from_J, const solid::Box& J, std::span<Touch<T>>);
template <class T>
void touch_frustum(const solid::Frustum& I, const RelativeFrame<T>& I_from_J, const solid::Frustum& J,
                   std::span<Touch<T>>);
template <class T>
void touch_frustum(const solid::Frustum& I, const RelativeFrame<T>& I_from_J, const ConvexBody& J, std::span<Touch<T>>);

}  // namespace dynalin

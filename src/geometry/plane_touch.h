// Where two curves in a plane are nearest to each other, or deepest in each other. That of I is seen along z of J: its
// points may stand above or below the plane of J's curve, which is as good as the cylinder over it.
#pragma once

#include "geometry/plane_curve.h"
#include "geometry/touch.h"

namespace dynalin {

// Of one pair of curves. Where more of them are closed, the last one is not defined.
inline constexpr std::size_t most_plane_touches = 16;

// All places where the distance of the curves is least for motions along them, the deepest first, and corners that
// stand in the other one; what is left of `out` is far away.
template <class T>
void touch_curves(const PlaneCurve& I, bool I_reversed, const RelativeFrame<T>& I_from_J, const PlaneCurve& J,
                  bool J_reversed, std::span<Touch<T>> out);
// The nearest place of a curve to a point, one.
template <class T>
Touch<T> touch_point(const Vec3<T>& point, const PlaneCurve&, bool reversed);

}  // namespace dynalin

// Where two boxes overlap. All places have the normal along which the boxes part soonest (separating axes); seen along
// it they are the corners of either face within the other one and the crossings of their edges.
#pragma once

#include "geometry/touch.h"

namespace dynalin {

// 4 corners of I's face, 4 of J's, and each edge of the one with each of the other.
inline constexpr std::size_t box_touches = 24;

template <class T>
void touch_boxes(const solid::Box& I, const RelativeFrame<T>& I_from_J, const solid::Box& J, std::span<Touch<T>>);

}  // namespace dynalin

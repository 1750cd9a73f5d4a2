// The other one of two bodies from the one.
#pragma once

#include "mechanics/path.h"

namespace dynalin {

// J seen from I.
template <class T>
RelativeFrame<T> seen_back(const RelativeFrame<T>& I_from_J) {
  const auto& [p, x, y, z] = I_from_J;
  return {-Vec3<T>{dot(x, p), dot(y, p), dot(z, p)}, {x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}};
}

}  // namespace dynalin

// How far an ellipsoid and a convex solid are apart along a direction n, from the points of both that are farthest
// along it: what of all directions has the largest of it is the normal of a contact, and this says whether one that was
// found is.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/solid.h"

namespace dynalin::solid {

// The largest n·x of a solid.
inline double support(const Frustum& f, const Vector& n) {
  const double across = std::hypot(n.x, n.y);
  return std::max(f.low_radius * across + f.low * n.z, f.high_radius * across + f.high * n.z);
}
inline double support(const Box& b, const Vector& n) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += std::max(n[k] * b.low[k], n[k] * b.high[k]);
  return sum;
}

// Whether some direction has a separation above `limit`, as far as a look at some hundred of them and a walk uphill
// from the best can tell. `separation` of a unit vector.
template <class Separation>
bool some_direction_exceeds(double limit, const Separation& separation) {
  constexpr int count = 200;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  Vector best{0, 0, 1};
  double most = separation(best);
  const auto look = [&](const Vector& n) {
    const double here = separation(n);
    if (here <= most) return false;
    most = here, best = n;
    return true;
  };
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - z * z);
    look({r * std::cos(golden * k), r * std::sin(golden * k), z});
  }
  // Along a ridge that is as high all along it would go on with ever smaller gains.
  int steps = 300;
  for (double step = 0.2; step > 1e-5 && most <= limit && steps > 0; --steps) {
    const Vector from = best;
    bool better = false;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const double way : {step, -step}) {
        Vector n = from;
        n[k] += way;
        better = look(n / norm(n)) || better;
      }
    }
    if (!better) step *= 0.5;
  }
  return most > limit;
}

}  // namespace dynalin::solid

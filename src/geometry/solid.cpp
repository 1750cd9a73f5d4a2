#include "geometry/solid.h"

#include <algorithm>
#include <limits>

namespace dynalin::solid {

namespace {

Bounds of(const Ball& b) { return {{}, b.radius}; }
Bounds of(const Ellipsoid& e) { return {{}, std::max({e.semi_axes.x, e.semi_axes.y, e.semi_axes.z})}; }
Bounds of(const Frustum& f) {
  return {{0, 0, 0.5 * (f.low + f.high)}, std::hypot(0.5 * (f.high - f.low), std::max(f.low_radius, f.high_radius))};
}
Bounds of(const Torus& t) { return {{}, t.major + t.minor}; }
Bounds of(const Box& b) { return {0.5 * (b.low + b.high), 0.5 * norm(b.high - b.low)}; }
Bounds of(const Plane&) { return {{}, std::numeric_limits<double>::infinity()}; }
Bounds of(const Polyhedron& f) { return {f.body->centre(), f.body->radius()}; }
Bounds of(const Profile& p) { return {p.curve->centre(), p.curve->radius()}; }

}  // namespace

Bounds bounds(const Side& side) {
  if (side.reversed) return {{}, std::numeric_limits<double>::infinity()};
  return std::visit([](const auto& shape) { return of(shape); }, side.shape);
}

}  // namespace dynalin::solid

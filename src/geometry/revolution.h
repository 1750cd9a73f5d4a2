// Surfaces of revolution about z: cylinders, frusta, ellipsoids, tori, and what a profile sweeps.
#pragma once

#include <numbers>
#include <span>

#include "geometry/mesh.h"

namespace dynalin {

inline constexpr double rounding_of_turn = 1e-9;  // of a whole one: 360D has some

// A part of a turn about z, right-handed from azimuth `start`, that x has as 0.
struct Sweep {
  double angle = 2 * std::numbers::pi;  // [rad], of either sign, at most one turn
  double start = 0;
  std::size_t segments = 20;  // straight pieces; no fewer than one for each 120 degrees are made

  bool full() const;
};

// A point of the profile, in a plane through z.
struct Meridian {
  double radius = 0, height = 0;  // radius ≥ 0
};

// What a profile sweeps. `ring`: its last point goes on to the first. A ring, and a profile with both ends on z, bound
// a volume, a wedge where the sweep is no full turn. A ring of a wedge must not cross itself: if it does, its two ends
// stay open.
Mesh revolved(std::span<const Meridian> profile, bool ring, const Sweep&);

// From z = 0 to `length`, of either sign; a radius of 0 makes it end in a point. Not both radii are 0.
Mesh frustum(double bottom_radius, double top_radius, double length, const Sweep&);
Mesh cylinder(double radius, double length, const Sweep&);
// About the origin, axes along x, y, z. Half as many bands from pole to pole as segments around.
Mesh ellipsoid(const Vector& semi_axes, std::size_t segments);
// Half as many segments around the tube as for a full turn about z. minor < major
Mesh torus(double major_radius, double minor_radius, const Sweep&);

}  // namespace dynalin

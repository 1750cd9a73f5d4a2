// Solids, surfaces and curves in closed form, and facets, each in the axes of a frame of its own: what contacts are
// calculated from.
#pragma once

#include <cmath>
#include <memory>
#include <variant>

#include "base/vec3.h"
#include "geometry/facet_body.h"
#include "geometry/plane_curve.h"

namespace dynalin::solid {

// Of the size of a shape: what is told apart. A place as near as another one but for so much is not the nearest.
inline constexpr double coincidence = 1e-9;

// About the origin. A point is a ball of radius 0.
struct Ball {
  double radius = 0;  // [length]
};
// About the origin, axes along x, y, z.
struct Ellipsoid {
  Vector semi_axes;
};
// About z between two heights; a cylinder where both radii are equal, a cone where one is 0.
struct Frustum {
  double low = 0, low_radius = 0, high = 0, high_radius = 0;  // low < high
};
// The tube of radius `minor` about a circle in the plane of x and y.
struct Torus {
  double major = 0, minor = 0;
};
struct Box {
  Vector low, high;
};
// A rectangle in the plane z = 0; what lies below it is inside.
struct Plane {
  double xmin = 0, xmax = 0, ymin = 0, ymax = 0;
};

// What facets bound.
struct Polyhedron {
  std::shared_ptr<const FacetBody> body;
};

// What a curve in the plane z = 0 bounds there: no solid. It touches others of its kind and points.
struct Profile {
  std::shared_ptr<const PlaneCurve> curve;
};

using Shape = std::variant<Ball, Ellipsoid, Frustum, Torus, Box, Plane, Polyhedron, Profile>;

// One side of a contact: a shape, or what is left when it is taken out of space.
struct Side {
  Shape shape;
  bool reversed = false;  // a cavity; of a plane: what lies above it is inside
};

// A ball about `centre` that holds the surface, of an infinite radius where none does.
struct Bounds {
  Vector centre;
  double radius = 0;
};
Bounds bounds(const Side&);

inline bool is_profile(const Side& s) { return std::holds_alternative<Profile>(s.shape); }

}  // namespace dynalin::solid

// Rings, and what they are tried with.
#pragma once

#include <numbers>

#include "geometry/overlap_test_support.h"
#include "geometry/torus_solid.h"

namespace dynalin::torus_test {

inline constexpr double pi = std::numbers::pi;

// A floor at y = 0 with an edge turned up far away, which makes it hollow there.
inline FacetBody floor_with_edge() {
  return overlap_test::swept({{-2, -1}, {2, -1}, {2, 0.5}, {1.9, 0.5}, {1.9, 0}, {-2, 0}}, -2, 2);
}

inline TorusSolid ring() { return TorusSolid({0.5, 0.1}); }
inline TorusSolid bun() { return TorusSolid({0.3, 0.22}); }
inline double whole(const TorusSolid& s) { return 2 * pi * pi * s.major() * s.minor() * s.minor(); }

// z of the ring is y of the body.
inline const RelativeFrame<double> flat{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};

}  // namespace dynalin::torus_test

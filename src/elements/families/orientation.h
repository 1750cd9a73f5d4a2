// Orientation as datasets state it: 3-1-3 angles, or points on the z axis and in the x-z plane.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/vec3.h"
#include "model/reader.h"

namespace dynalin {

struct WrittenOrientation {
  std::optional<Vector> angles;   // REULER [rad]
  std::optional<Vector> z_point;  // a point on +z
  std::optional<Vector> x_point;  // a point in the x-z plane, on the side of +x
  std::string_view angles_name, z_name, x_name;
  bool x_exact = false;  // USEXP: x_point lies on +x, z_point fixes the plane
};

// The axes by columns, in the frame in which origin and points are given. Only a z point: x is the projection of the
// frame's x on the plane normal to z (y if z is along x). Only an x point: z stays that of the frame as near as it
// can. Reports contradictions and degenerate points; nothing then.
std::optional<Matrix3> orientation(const WrittenOrientation&, const Vector& origin, ElementReader&);

}  // namespace dynalin

// What contacts see of the types that have a form in closed terms.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "elements/graphics/types.h"

namespace dynalin::drawing {

namespace {

bool is_turn(double angle) { return std::abs(angle) >= 2 * std::numbers::pi * (1 - 1e-9); }

solid::Frustum between(double length, double bottom, double top) {
  if (length > 0) return {0, bottom, length, top};
  return {length, top, 0, bottom};
}

}  // namespace

std::optional<ContactShape> Box::contact_shape() const {
  const Vector far{x, y, z};
  solid::Box box;
  for (std::size_t k = 0; k < 3; ++k) box.low[k] = std::min(0.0, far[k]), box.high[k] = std::max(0.0, far[k]);
  return ContactShape{corner, box};
}

std::optional<ContactShape> Cylinder::contact_shape() const {
  if (!is_turn(angle)) return std::nullopt;
  return ContactShape{cm, between(length, radius, radius)};
}

std::optional<ContactShape> Frustum::contact_shape() const {
  if (!is_turn(angle)) return std::nullopt;
  return ContactShape{cm, between(length, bottom, top)};
}

std::optional<ContactShape> Ellipsoid::contact_shape() const {
  if (x == y && y == z) return ContactShape{cm, solid::Ball{0.5 * x}};
  return ContactShape{cm, solid::Ellipsoid{0.5 * Vector{x, y, z}}};
}

std::optional<ContactShape> Torus::contact_shape() const {
  if (!is_turn(angle)) return std::nullopt;
  return ContactShape{cm, solid::Torus{*major, *minor}};
}

std::optional<ContactShape> Plane::contact_shape() const {
  return ContactShape{rm, solid::Plane{xmin, xmax, ymin, ymax}};
}

std::optional<ContactShape> Point::contact_shape() const { return ContactShape{rm, solid::Ball{0}}; }

}  // namespace dynalin::drawing

// What contacts see of the types that have a form in closed terms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "elements/families/common_frame.h"
#include "elements/families/curve.h"
#include "elements/graphics/types.h"

namespace dynalin::drawing {

namespace {

bool is_turn(double angle) { return std::abs(angle) >= 2 * std::numbers::pi * (1 - 1e-9); }

solid::Frustum between(double length, double bottom, double top) {
  if (length > 0) return {0, bottom, length, top};
  return {length, top, 0, bottom};
}

solid::Profile profile(PlaneCurve curve) { return {std::make_shared<const PlaneCurve>(std::move(curve))}; }

constexpr double out_of_plane = 1e-9;  // of the size of a curve: what of it may leave its plane

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

std::optional<ContactShape> Circle::contact_shape() const {
  return ContactShape{cm, profile(PlaneCurve::circle(radius, 2 * std::numbers::pi))};
}

std::optional<ContactShape> Arc::contact_shape() const {
  return ContactShape{cm, profile(PlaneCurve::circle(radius, angle))};
}

std::optional<ContactShape> CurveLine::contact_shape(const Model& model, std::string& why) const {
  const auto& shape = model.get<dynalin::Curve>(curve)->shape;
  why.clear();  // its error is reported
  if (!shape) return std::nullopt;
  double height = 0, size = 0;
  for (const double u : shape->samples(std::numeric_limits<std::size_t>::max())) {
    const Vector p = shape->at(u);
    height = std::max(height, std::abs(p.z)), size = std::max(size, norm(p));
  }
  if (height <= out_of_plane * size) return ContactShape{rm, profile(PlaneCurve::of(shape))};
  why = fmt::format("a CURVE that leaves the plane of x and y by {:.6g}", height);
  return std::nullopt;
}

// In the plane of x and y of its first marker.
std::optional<ContactShape> OutlineOf::contact_shape(const Model& model, std::string& why) const {
  why.clear();  // so is that of its markers
  if (points.size() < 2) return std::nullopt;
  const MarkerPlace& first = model.marker(points.front()).place;
  std::vector<Vector> corners;
  double height = 0, size = 0;
  for (const MarkerId m : points) {
    const MarkerPlace& place = model.marker(m).place;
    if (!move_as_one(model, m, points.front())) {
      why = "an OUTLINE on several bodies or on several nodes of one";
      return std::nullopt;
    }
    Vector p = transpose_times(first.R_BM, place.p_BM - first.p_BM);
    height = std::max(height, std::abs(p.z)), size = std::max(size, norm(p));
    p.z = 0;
    if (corners.empty() || norm(p - corners.back()) > 0) corners.push_back(p);
  }
  // The same place by another way of calculation closes it as well.
  if (corners.size() > 3 && norm(corners.back() - corners.front()) <= out_of_plane * size)
    corners.back() = corners.front();
  if (height <= out_of_plane * size && corners.size() > 1)
    return ContactShape{points.front(), profile(PlaneCurve::polygon(corners))};
  why = corners.size() > 1
            ? fmt::format("an OUTLINE that leaves the plane of x and y of its first marker by {:.6g}", height)
            : "an OUTLINE of one point";
  return std::nullopt;
}

}  // namespace dynalin::drawing

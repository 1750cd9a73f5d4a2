// Plates, links, and what a CURVE sweeps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/families/common_frame.h"
#include "elements/graphics/checks.h"
#include "elements/graphics/types.h"
#include "geometry/plate.h"
#include "geometry/polygon.h"
#include "geometry/prism.h"

namespace dynalin::drawing {

namespace {

// The same outline `shift` along z.
std::vector<Vector> lifted(std::vector<Vector> outline, double shift) {
  for (Vector& p : outline) p.z += shift;
  return outline;
}

// Points that are the one before them left out, and those in the middle of straight pieces.
std::vector<Vector> without_straight_points(const std::vector<Vector>& points) {
  constexpr double sine_of_straight = 1e-12;
  std::vector<Vector> kept;
  for (const Vector& p : points) {
    if (!kept.empty() && norm(p - kept.back()) == 0) continue;
    while (kept.size() > 1) {
      const Vector in = kept.back() - kept[kept.size() - 2], out = p - kept.back();
      if (norm(cross(in, out)) > sine_of_straight * norm(in) * norm(out) || dot(in, out) < 0) break;
      kept.pop_back();
    }
    kept.push_back(p);
  }
  return kept;
}

}  // namespace

void Plate::complete(ElementReader& reader) {
  demand_positive(reader, "THICKNESS", thickness);
  const std::size_t errors = reader.diagnostics().error_count();
  corners = listed_markers(reader, "MARKERS");
  if (corners.size() >= 3 || !reader.given("MARKERS") || reader.diagnostics().error_count() > errors) return;
  reader.error(
      "wrong-count", reader.at("MARKERS"),
      fmt::format("MARKERS of {} lists {} markers, a plate needs three", reader.label().text(), corners.size()));
}

void Plate::check(const Model& model, const ElementLabel& label, Diagnostics& diagnostics) const {
  const BodyId body = model.marker(corners.front()).place.body;
  for (const MarkerId m : corners) {
    const Marker& marker = model.marker(m);
    if (on_one_body(model, m, corners.front())) continue;
    diagnostics.error("foreign-marker", label.at,
                      fmt::format("{} is a corner of {} and must be on {} as the first one is", marker.label->text(),
                                  label.text(), model.body(body).label.text()));
  }
}

// In the plane of the corners, or the one nearest to all of them, with z on the side of z of the first marker.
void Plate::draw(Canvas& canvas) const {
  std::vector<Vector> at;
  for (const MarkerId m : corners) at.push_back(canvas.frame(m).origin);
  const Frame<double> first = canvas.frame(corners.front());
  Vector area = vector_area(at);
  if (norm(area) == 0) return canvas.leave_out("its corners are on one line");
  if (dot(area, first.axes.z) < 0) area = -area;
  Vector centre;
  for (const Vector& p : at) centre += (p - first.origin) / static_cast<double>(at.size());
  const Frame<double> plane = frame_along(first.origin + centre, area, first.axes.x, first.axes.y);
  for (Vector& p : at) p = transpose_times(plane.axes, p - plane.origin);
  const auto outline = rounded_outline(at, radius, pieces(segments));
  if (!outline) return canvas.leave_out("its corners are on one line, or its sides too short for RADIUS");
  Mesh mesh = prism(lifted(*outline, -thickness / 2), Outline::closed, {0, 0, thickness});
  if (!mesh.closed) return canvas.leave_out("its outline crosses itself");
  canvas.add(canvas.body(corners.front()), placed(std::move(mesh), plane));
}

void Link::complete(ElementReader& reader) {
  demand_positive(reader, "WIDTH", width), demand_positive(reader, "DEPTH", depth);
}
void Link::draw(Canvas& canvas) const {
  const Frame<double> I = canvas.frame(i);
  const Vector to_J = canvas.frame(j).origin - I.origin;
  const double length = norm(to_J);
  if (length == 0) return canvas.leave_out("its markers are at the same point");
  // z along the link, x along the depth.
  const Frame<double> frame = frame_along(I.origin, to_J, I.axes.z, I.axes.x);
  const std::array<Vector, 2> ends{Vector{}, Vector{length, 0, 0}};
  const auto outline = rounded_outline(ends, width / 2, pieces(segments));
  Mesh mesh = prism(lifted(*outline, -depth / 2), Outline::closed, {0, 0, depth});
  const Matrix3 axes{frame.axes.z, frame.axes.y, -frame.axes.x};
  canvas.add(canvas.body(i), placed(std::move(mesh), {frame.origin, axes}));
}

void Extrusion::complete(ElementReader& reader) { demand_not_zero(reader, "LENGTH", length); }
void Extrusion::draw(Canvas& canvas) const {
  auto profile = without_straight_points(canvas.along(curve, segments ? pieces(segments) : 0));
  const bool closed = canvas.is_closed(curve) && profile.size() > 3;
  if (closed) profile.pop_back();
  Mesh mesh = prism(profile, closed ? Outline::closed : Outline::open, {0, 0, length});
  drop_loose_vertices(mesh);
  if (mesh.faces() == 0) return canvas.leave_out("its profile is along z");
  canvas.add(rm, std::move(mesh));
}

void Revolution::complete(ElementReader& reader) { demand_angle(reader, angle); }
void Revolution::draw(Canvas& canvas) const {
  const auto points = without_straight_points(canvas.along(curve, sides ? pieces(sides) : 0));
  double size = 0;
  for (const Vector& p : points) size = std::max(size, norm(p));
  // The surface only knows how far from the axis the profile is; a wedge begins where its first point off the axis is.
  constexpr double rounding_of_radius = 1e-12;
  std::vector<Meridian> profile;
  std::optional<double> start;
  for (const Vector& p : points) {
    const double radius = std::hypot(p.x, p.y);
    const bool on_axis = radius <= rounding_of_radius * size;
    if (!on_axis && !start) start = std::atan2(p.y, p.x);
    profile.push_back({on_axis ? 0 : radius, p.z});
  }
  if (!start) return canvas.leave_out("its profile is on z");
  const bool ring = canvas.is_closed(curve) && profile.size() > 3;
  if (ring) profile.pop_back();
  Mesh mesh = revolved(profile, ring, {.angle = angle, .start = *start, .segments = pieces(segments)});
  drop_loose_vertices(mesh);
  canvas.add(rm, std::move(mesh));
}

}  // namespace dynalin::drawing

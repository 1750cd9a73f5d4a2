#include "elements/graphics/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/families/curve.h"
#include "geometry/lines.h"

namespace dynalin {

void Canvas::add(MarkerId m, Mesh mesh) {
  const MarkerPlace& place = model_.marker(m).place;
  shapes_.push_back({label_, origin_, place.body, placed(std::move(mesh), {place.p_BM, place.R_BM}), {}});
}

void Canvas::add(BodyId b, Mesh mesh) {
  const Pose& pose = poses_[static_cast<std::size_t>(b.index)];
  for (Vector& p : mesh.vertices) p = transpose_times(pose.R, p - pose.r);
  shapes_.push_back({label_, origin_, b, std::move(mesh), {}});
}

void Canvas::add_line(std::span<const MarkerId> markers) {
  Shape shape{label_, origin_, body(markers.front()), {}, {}};
  Vector before;
  for (const MarkerId m : markers) {
    const Vector here = frame(m).origin;
    if (!shape.mesh.vertices.empty() && norm(here - before) == 0) continue;
    const Mesh::Index v = shape.mesh.add(model_.marker(m).place.p_BM);
    if (v > 0) shape.mesh.segments.push_back({v - 1, v});
    shape.vertex_bodies.push_back(body(m));
    before = here;
  }
  if (shape.mesh.segments.empty()) return leave_out("all its points are the same");
  const auto on_the_first = [&](BodyId b) { return b == shape.body; };
  if (std::all_of(shape.vertex_bodies.begin(), shape.vertex_bodies.end(), on_the_first)) shape.vertex_bodies.clear();
  shapes_.push_back(std::move(shape));
}

Frame<double> Canvas::frame(MarkerId m) const {
  const MarkerPlace& place = model_.marker(m).place;
  const Pose& pose = poses_[static_cast<std::size_t>(place.body.index)];
  return {pose.r + pose.R * place.p_BM, pose.R * place.R_BM};
}

std::vector<Vector> Canvas::along(CurveRef ref, std::size_t segments) const {
  constexpr std::size_t fewest = 20, most = 2000;
  const ParametricCurve& curve = *model_.get<Curve>(ref)->shape;
  std::vector<double> at = curve.samples(most);
  if (segments > 0) {
    const double begin = at.front(), end = at.back();
    at.clear();
    for (std::size_t k = 0; k <= segments; ++k)
      at.push_back(begin + (end - begin) * static_cast<double>(k) / static_cast<double>(segments));
  } else if (at.size() <= fewest) {
    // Between what is there, so that corners of a polygon stay.
    const std::size_t between = (fewest + at.size() - 2) / (at.size() - 1);
    std::vector<double> finer{at.front()};
    for (std::size_t k = 1; k < at.size(); ++k) {
      for (std::size_t i = 1; i <= between; ++i)
        finer.push_back(at[k - 1] + (at[k] - at[k - 1]) * static_cast<double>(i) / static_cast<double>(between));
    }
    at = std::move(finer);
  }
  std::vector<Vector> points;
  for (const double u : at) points.push_back(curve.at(u));
  if (is_closed(ref)) points.back() = points.front();
  return points;
}

bool Canvas::is_closed(CurveRef ref) const {
  return model_.get<Curve>(ref)->shape->shape() == ParametricCurve::Shape::closed;
}

void Canvas::leave_out(std::string_view why) {
  remark("undrawn-shape", label_.at, fmt::format("{} is not drawn: {}", label_.full_text(), why));
}

Frame<double> frame_along(const Vector& origin, const Vector& z, const Vector& x, const Vector& otherwise) {
  constexpr double all_but_along = 0.99;
  const Vector axis = normalized(z);
  const Vector& wanted = std::abs(dot(axis, x)) < all_but_along * norm(x) ? x : otherwise;
  const Vector across = normalized(wanted - dot(wanted, axis) * axis);
  return {origin, {across, cross(axis, across), axis}};
}

Mesh placed(Mesh mesh, const Frame<double>& frame) {
  for (Vector& p : mesh.vertices) p = frame.origin + frame.axes * p;
  return mesh;
}

}  // namespace dynalin

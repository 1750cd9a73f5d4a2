// Lines, planes and points.
#include <fmt/format.h>

#include <array>

#include "elements/graphics/checks.h"
#include "elements/graphics/types.h"
#include "geometry/lines.h"
#include "geometry/polygon.h"

namespace dynalin::drawing {

void Circle::complete(ElementReader& reader) { demand_positive(reader, "RADIUS", radius); }
void Circle::draw(Canvas& canvas) const { canvas.add(cm, arc(radius, {.segments = pieces(segments)})); }

void Arc::complete(ElementReader& reader) {
  demand_positive(reader, "RADIUS", radius);
  if (reader.given("RANGLE")) demand_angle(reader, angle);
}
void Arc::draw(Canvas& canvas) const { canvas.add(cm, arc(radius, sweep_of(angle, segments))); }

void OutlineOf::complete(ElementReader& reader) {
  const std::string_view name = reader.given("MARKERS") ? "MARKERS" : "OUTLINE";
  const std::size_t errors = reader.diagnostics().error_count();
  points = listed_markers(reader, name);
  if (points.size() >= 2 || reader.statement().damaged || reader.diagnostics().error_count() > errors) return;
  reader.error("wrong-count", reader.at(name),
               fmt::format("{} of {} lists {} markers, a line needs two", name, reader.label().text(), points.size()));
}
void OutlineOf::draw(Canvas& canvas) const { canvas.add_line(points); }

void CurveLine::draw(Canvas& canvas) const {
  const auto points = canvas.along(curve, segments ? pieces(segments) : 0);
  Mesh mesh = polyline(points);
  if (canvas.is_closed(curve) && mesh.segments.size() > 2) {
    mesh.vertices.pop_back();  // it is the first one
    mesh.segments.back()[1] = 0;
  }
  canvas.add(rm, std::move(mesh));
}

void Plane::complete(ElementReader& reader) {
  const auto check = [&](std::string_view low, std::string_view high, double from, double to) {
    if (!reader.given(low) || !reader.given(high) || from < to) return;
    reader.error(
        "value-out-of-range", reader.at(high),
        fmt::format("{} of {} is {}, it must be more than {}, {}", high, reader.label().text(), to, low, from));
  };
  check("XMIN", "XMAX", xmin, xmax), check("YMIN", "YMAX", ymin, ymax);
}
void Plane::draw(Canvas& canvas) const {
  Mesh mesh;
  mesh.vertices = {{xmin, ymin, 0}, {xmax, ymin, 0}, {xmax, ymax, 0}, {xmin, ymax, 0}};
  mesh.quads = {{0, 1, 2, 3}};
  canvas.add(rm, std::move(mesh));
}

void Point::draw(Canvas& canvas) const {
  Mesh mesh;
  mesh.points = {mesh.add({})};
  canvas.add(rm, std::move(mesh));
}

}  // namespace dynalin::drawing

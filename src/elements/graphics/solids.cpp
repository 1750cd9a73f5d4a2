// Boxes, and what is round about z.
#include <fmt/format.h>

#include "elements/graphics/checks.h"
#include "elements/graphics/types.h"
#include "geometry/prism.h"

namespace dynalin::drawing {

void Box::complete(ElementReader& reader) {
  demand_not_zero(reader, "X", x), demand_not_zero(reader, "Y", y), demand_not_zero(reader, "Z", z);
}
void Box::draw(Canvas& canvas) const { canvas.add(corner, box({x, y, z})); }

void Cylinder::complete(ElementReader& reader) {
  demand_not_zero(reader, "LENGTH", length);
  demand_positive(reader, "RADIUS", radius);
  demand_angle(reader, angle);
}
void Cylinder::draw(Canvas& canvas) const { canvas.add(cm, cylinder(radius, length, sweep_of(angle, segments))); }

void Frustum::complete(ElementReader& reader) {
  demand_not_zero(reader, "LENGTH", length);
  if (bottom == 0) demand_not_zero(reader, "TOP", top);  // one of them may be
  demand_angle(reader, angle);
}
void Frustum::draw(Canvas& canvas) const { canvas.add(cm, frustum(bottom, top, length, sweep_of(angle, segments))); }

void Ellipsoid::complete(ElementReader& reader) {
  demand_positive(reader, "XSCALE", x), demand_positive(reader, "YSCALE", y), demand_positive(reader, "ZSCALE", z);
}
void Ellipsoid::draw(Canvas& canvas) const { canvas.add(cm, ellipsoid(0.5 * Vector{x, y, z}, pieces(segments))); }

void Torus::complete(ElementReader& reader) {
  const auto one_of = [&](std::optional<double>& value, std::string_view name, const std::optional<double>& other,
                          std::string_view other_name) {
    if (!reader.given(name) && !reader.given(other_name) && !reader.statement().damaged) {
      reader.error("missing-argument", reader.statement().at, fmt::format("{} needs {}", reader.label().text(), name));
    } else if (reader.given(name) && reader.given(other_name)) {
      reader.error("excluded-arguments", reader.at(other_name),
                   fmt::format("{} of {} is another name of {}", other_name, reader.label().text(), name));
    }
    const std::string_view used = reader.given(name) ? name : other_name;
    if (!value) value = other;
    if (value) demand_positive(reader, used, *value);
    return used;
  };
  one_of(major, "MAJOR_RADIUS", rmajor, "RMAJOR");
  const std::string_view tube = one_of(minor, "MINOR_RADIUS", rminor, "RMINOR");
  if (major && minor && *major > 0 && *minor >= *major) {
    reader.error("value-out-of-range", reader.at(tube),
                 fmt::format("{} of {} is {}, it must be less than the radius of the circle that the tube follows, {}",
                             tube, reader.label().text(), *minor, *major));
  }
  demand_angle(reader, angle);
}
void Torus::draw(Canvas& canvas) const { canvas.add(cm, torus(*major, *minor, sweep_of(angle, segments))); }

}  // namespace dynalin::drawing

#include "elements/families/curve_contact.h"

#include <algorithm>

#include "elements/families/markers.h"

namespace dynalin {

namespace {

// Whether the modes of a body move both alike: always if they belong to one node.
bool move_alike(const MarkerPlace& a, const MarkerPlace& b) {
  if (!a.shapes || !b.shapes) return a.shapes == b.shapes;
  const auto same = [](const Vector& v, const Vector& w) { return v.x == w.x && v.y == w.y && v.z == w.z; };
  return std::ranges::equal(a.shapes->translation, b.shapes->translation, same) &&
         std::ranges::equal(a.shapes->rotation, b.shapes->rotation, same);
}

}  // namespace

double stated_parameter(const Model& model, const Curve& curve, const Vector& point, MarkerId own, MarkerId axes) {
  const Pose to = drawn_on_body(model, own), from = drawn_on_body(model, axes.valid() ? axes : own);
  const Vector in_body = from.r + from.R * point;
  return curve.shape->nearest(transpose_times(to.R, in_body - to.r));
}

bool check_contact_marker(Model& model, const ElementLabel& label, MarkerId floating, std::string_view argument,
                          MarkerId own, Diagnostics& diagnostics) {
  const Marker& marker = model.marker(floating);
  if (!marker.floating) {
    diagnostics.error(
        "fixed-marker", label.at,
        fmt::format("{} of {}, {}, must be a floating marker", argument, label.text(), marker.label->text()),
        "write FLOATING into the MARKER statement");
    return false;
  }
  const BodyId body = model.marker(own).place.body;
  if (marker.place.body != body) {
    diagnostics.error("foreign-marker", label.at,
                      fmt::format("{} of {}, {}, must be on {}, which carries the curve", argument, label.text(),
                                  marker.label->text(), model.body(body).label.text()));
    return false;
  }
  if (marker.place.shapes && !move_alike(marker.place, model.marker(own).place)) {
    diagnostics.error(
        "foreign-marker", label.at,
        fmt::format("{} of {}, {}, is on another node of {} than {}, which carries the curve", argument, label.text(),
                    marker.label->text(), model.body(body).label.text(), model.marker(own).label->text()),
        "a floating marker of a flexible body needs no NODE_ID");
    return false;
  }
  return true;
}

void check_start_point(ElementReader& reader, bool has_axes, bool has_point, std::string_view axes,
                       std::string_view point) {
  if (!has_axes || has_point) return;
  reader.error("unexpected-argument", reader.at(axes),
               fmt::format("{} of {} goes with {}", axes, reader.label().text(), point));
}

bool check_start_axes(const Model& model, const ElementLabel& label, MarkerId axes, std::string_view argument,
                      MarkerId own, Diagnostics& diagnostics) {
  if (!axes.valid()) return true;
  const Marker& marker = model.marker(axes);
  const BodyId body = model.marker(own).place.body;
  if (!check_fixed(model, label, axes, argument, diagnostics)) return false;
  if (marker.place.body == body) return true;
  diagnostics.error("foreign-marker", label.at,
                    fmt::format("{} of {}, {}, must be on {}, which carries the curve", argument, label.text(),
                                marker.label->text(), model.body(body).label.text()));
  return false;
}

}  // namespace dynalin

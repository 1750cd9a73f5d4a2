#include "elements/families/markers.h"

#include <fmt/format.h>

#include "mechanics/deformation.h"

namespace dynalin {

bool check_pair(const Model& model, const ElementLabel& label, MarkerId i, MarkerId j, const PairRequirements& needs,
                Diagnostics& diagnostics) {
  bool ok = true;
  const auto check_one = [&](MarkerId m, bool needs_rotation) {
    const Marker& marker = model.marker(m);
    const Body& body = model.body(marker.place.body);
    if (marker.floating) {
      diagnostics.error("floating-marker", label.at,
                        fmt::format("{} uses {}, which is floating", label.text(), marker.label->text()),
                        "a fixed marker is needed here");
      ok = false;
    }
    if (needs_rotation && body.kind == BodyKind::point_mass) {
      diagnostics.error("rotation-of-point-mass", label.at,
                        fmt::format("{} acts on the rotation of {}, which has none", label.text(), body.label.text()));
      ok = false;
    }
  };
  check_one(i, needs.rotation_of_I);
  check_one(j, needs.rotation_of_J);
  if (needs.different_bodies && model.marker(i).place.body == model.marker(j).place.body) {
    diagnostics.error(
        "same-body", label.at,
        fmt::format("I and J of {} are both on {}", label.text(), model.body(model.marker(i).place.body).label.text()));
    ok = false;
  }
  return ok;
}

namespace {

// In global axes, on a flexible body with the shape that it starts in.
Pose drawn_pose(const Model& model, const MarkerPlace& m) {
  const Body& body = model.body(m.body);
  const Pose& B = body.pose;
  if (!m.shapes) return {B.r + B.R * m.p_BM, B.R * m.R_BM};
  const auto shape = deformation<double>(*m.shapes, [&](std::size_t k) { return body.modal[k].initial; });
  return {B.r + B.R * (m.p_BM + shape.moved), B.R * (shape.turned * m.R_BM)};
}

}  // namespace

RelativeFrame<double> drawn_frame(const Model& model, MarkerId i, MarkerId j) {
  const Pose I = drawn_pose(model, model.marker(i).place), J = drawn_pose(model, model.marker(j).place);
  const Matrix3 A = transpose(J.R);
  const Matrix3 axes = A * I.R;
  return {A * (I.r - J.r), axes[0], axes[1], axes[2]};
}

}  // namespace dynalin

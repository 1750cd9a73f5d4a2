#include "elements/families/markers.h"

#include <fmt/format.h>

#include "mechanics/deformation.h"

namespace dynalin {

bool check_pair(const Model& model, const ElementLabel& label, MarkerId i, MarkerId j, const PairRequirements& needs,
                Diagnostics& diagnostics) {
  bool ok = true;
  const auto check_one = [&](MarkerId m, bool needs_rotation) {
    const Marker& marker = model.marker(m);
    if (marker.floating) {
      diagnostics.error("floating-marker", label.at,
                        fmt::format("{} uses {}, which is floating", label.text(), marker.label->text()),
                        "a fixed marker is needed here");
      ok = false;
    }
    if (needs_rotation && !check_rotation(model, label, m, diagnostics)) ok = false;
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

bool check_fixed(const Model& model, const ElementLabel& label, MarkerId m, std::string_view argument,
                 Diagnostics& diagnostics) {
  const Marker& marker = model.marker(m);
  if (!marker.floating) return true;
  diagnostics.error("floating-marker", label.at,
                    fmt::format("{} of {}, {}, is floating", argument, label.text(), marker.label->text()),
                    "a fixed marker is needed here");
  return false;
}

void check_velocity_axes(const Model& model, const ElementLabel& label, MarkerId vm, MarkerId wm,
                         Diagnostics& diagnostics) {
  if (vm.valid()) check_fixed(model, label, vm, "VM", diagnostics);
  if (wm.valid()) check_fixed(model, label, wm, "WM", diagnostics);
}

bool check_rotation(const Model& model, const ElementLabel& label, MarkerId m, Diagnostics& diagnostics) {
  const Marker& marker = model.marker(m);
  const Body& body = model.body(marker.place.body);
  if (body.kind != BodyKind::point_mass) return true;
  diagnostics.error("rotation-of-point-mass", label.at,
                    fmt::format("{} acts by {} on the rotation of {}, which has none", label.text(),
                                marker.label->text(), body.label.text()));
  return false;
}

namespace {

Pose drawn_pose(const Model& model, MarkerId m) {
  const Pose& B = model.body(model.marker(m).place.body).pose;
  const Pose on_body = drawn_on_body(model, m);
  return {B.r + B.R * on_body.r, B.R * on_body.R};
}

}  // namespace

Pose drawn_on_body(const Model& model, MarkerId id) {
  const MarkerPlace& m = model.marker(id).place;
  if (!m.shapes) return {m.p_BM, m.R_BM};
  const Body& body = model.body(m.body);
  const auto shape = deformation<double>(*m.shapes, [&](std::size_t k) { return body.nature->modal[k].initial; });
  return {m.p_BM + shape.moved, shape.turned * m.R_BM};
}

RelativeFrame<double> drawn_frame(const Model& model, MarkerId i, MarkerId j) {
  const Pose I = drawn_pose(model, i), J = drawn_pose(model, j);
  const Matrix3 A = transpose(J.R);
  const Matrix3 axes = A * I.R;
  return {A * (I.r - J.r), axes[0], axes[1], axes[2]};
}

}  // namespace dynalin

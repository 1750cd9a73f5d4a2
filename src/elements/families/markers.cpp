#include "elements/families/markers.h"

#include <fmt/format.h>

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

RelativeFrame<double> drawn_frame(const Model& model, MarkerId i, MarkerId j) {
  const MarkerPlace &I = model.marker(i).place, &J = model.marker(j).place;
  const Pose &B = model.body(I.body).pose, &C = model.body(J.body).pose;
  const Matrix3 A = transpose(C.R * J.R_BM);
  const Matrix3 axes = A * (B.R * I.R_BM);
  return {A * (B.r + B.R * I.p_BM - C.r - C.R * J.p_BM), axes[0], axes[1], axes[2]};
}

}  // namespace dynalin

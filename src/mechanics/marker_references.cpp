#include "mechanics/marker_references.h"

namespace dynalin {

MarkerFrame frame_of_marker(const Signals& signals, MarkerId m, Axes axes) {
  const Layout& layout = signals.layout();
  const MarkerId followed = signals.place_of(m);
  const CurvePoint* on = layout.curve_point(m);
  if (!on || (axes == Axes::unread && !(followed == m))) return {&layout.marker(followed)};
  return {&layout.marker(on->carrier), on->curve.get(), on->coordinate,
          static_cast<std::uint32_t>(layout.extra_index(on->coordinate))};
}

std::vector<MarkerLoad> loads_on(const Signals& signals, MarkerId i, std::optional<MarkerId> j) {
  std::vector<MarkerLoad> list;
  for (const Signals::Wrench& w : signals.wrenches_at(i)) {
    const bool is_I = w.source->marker_I(w.which) == i;
    const MarkerId other = is_I ? w.source->marker_J(w.which) : w.source->marker_I(w.which);
    if (!j || other == *j) list.push_back({w, !is_I});
  }
  return list;
}

Vector on_marker(const MarkerWrench& w, bool on_J, LoadPart part) {
  const bool torque = part == LoadPart::torque;
  if (!on_J) return torque ? w.force.torque : w.force.force;
  if (!w.force.acts_on_J()) return {};
  if (!torque) return -w.force.force;
  const Vector delta = value(w.pair.delta);
  return -w.force.torque - cross(delta, w.force.force);
}

}  // namespace dynalin

#include "analysis/turned_over.h"

#include "mechanics/held_axes.h"
#include "mechanics/signals.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

const ElementLabel* turned_over(const System& system, const OperatingPoint& from, const OperatingPoint& to) {
  const Layout& layout = system.layout();
  const Motion before = system.motion(from), after = system.motion(to);
  const ElementLabel* last = nullptr;
  for (const ConstraintRow& row : layout.rows) {
    if (row.owner == last) continue;
    last = row.owner;
    const Signals::Wrench w = system.signals().wrench(last->statement, last->id);
    const auto* held = dynamic_cast<const HeldAxes*>(w.source);
    if (!held || held->held_axes() == HeldAxes::Axes::none) continue;
    const MarkerPlace &I = layout.marker(w.source->marker_I(w.which)), &J = layout.marker(w.source->marker_J(w.which));
    const auto opposite = [&](std::size_t axis) {
      const auto along = [&](const Motion& m) { return dot(m.axes(I)[axis], m.axes(J)[axis]); };
      return along(before) * along(after) < 0;
    };
    if (opposite(2) || (held->held_axes() == HeldAxes::Axes::all && opposite(0))) return last;
  }
  return nullptr;
}

}  // namespace dynalin

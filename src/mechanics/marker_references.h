// What a marker leads to for those who read its motion, and the forces that act on it.
#pragma once

#include <optional>
#include <vector>

#include "mechanics/marker_frame.h"
#include "mechanics/signals.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

// Where a marker is, and its axes where they are read. One on a curve whose axes do not matter is as well at the origin
// of the fixed marker that lies there, if there is one. A floating marker without a place stands for itself.
enum class Axes : bool { unread, read };
MarkerFrame frame_of_marker(const Signals&, MarkerId, Axes);

// A wrench on a marker, of which it is I or J.
struct MarkerLoad {
  Signals::Wrench wrench;
  bool on_J = false;
};
// On marker I of all elements between I and J, or of all on I without J.
std::vector<MarkerLoad> loads_on(const Signals&, MarkerId i, std::optional<MarkerId> j);

// The force or the torque of such a wrench on the marker, global axes.
enum class LoadPart : bool { force, torque };
Vector on_marker(const MarkerWrench&, bool on_J, LoadPart);

}  // namespace dynalin

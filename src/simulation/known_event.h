// An event whose instant is known beforehand, as that of a sample is: no step goes over it, and the integration begins
// anew behind it.
#pragma once

#include <cmath>
#include <limits>

#include "system/system.h"

namespace dynalin {

struct KnownEvent {
  // From the event to its sides, in roundings; what is less is no step.
  static constexpr double way_around = 8, no_step = 1e3;

  double before = std::numeric_limits<double>::infinity(), behind = before;

  // The first after a point, if it is before the end of the run.
  static KnownEvent after(const System& system, const OperatingPoint& point, double end) {
    const double at = system.next_event(point);
    const double way = way_around * std::numeric_limits<double>::epsilon() * std::abs(at);
    if (at + way < end) return {at - way, at + way};
    return {};
  }
  bool follows_at_once(double time) const {
    return before - time < no_step * (std::numeric_limits<double>::epsilon() * std::abs(behind));
  }
};

}  // namespace dynalin

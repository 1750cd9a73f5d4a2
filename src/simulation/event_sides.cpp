#include "simulation/event_sides.h"

#include <cmath>
#include <limits>
#include <utility>

namespace dynalin {

namespace {

// Ways from the event, in roundings.
constexpr double first_way_back = 1e3, next_way = 10, least_way_ahead = 4, most_way_ahead = 400;

}  // namespace

void EventSides::take(double t, OperatingPoint& to) {
  integrator_.interpolate(t, y_, yp_);
  unknowns_.unpack(t, y_, yp_, to);
}

void EventSides::leave(OperatingPoint& point) {
  std::vector<double> values(events_.size());
  const double at = point.time, rounding = std::numeric_limits<double>::epsilon() * std::abs(at);
  for (double ahead = least_way_ahead; ahead <= most_way_ahead; ahead *= next_way) {
    events_.values(system_.motion(point), values);
    bool is_zero = false;
    for (std::size_t k = 0; k < events_.switch_count(); ++k)
      is_zero = is_zero || (integrator_.crossed()[k] != 0 && values[k] == 0);
    if (!is_zero) return;
    point.time = at + ahead * rounding;
    take(point.time, point);
  }
}

std::optional<OperatingPoint> EventSides::before(const OperatingPoint& last, const ConsistentPoints& points) {
  const double at = integrator_.time();
  const std::span<const int> crossed = integrator_.crossed().first(events_.switch_count());
  std::vector<double> values(events_.size());
  double back = first_way_back * std::numeric_limits<double>::epsilon() * (std::abs(at) + at - last.time);
  for (; at - back > last.time; back *= next_way) {
    OperatingPoint side = last;
    take(at - back, side);
    Findings unused;
    if (auto balanced = points.accelerations(side, unused)) side = std::move(*balanced);
    events_.values(system_.motion(side), values);
    bool is_beyond = false;
    for (std::size_t k = 0; k < crossed.size(); ++k) is_beyond = is_beyond || crossed[k] * values[k] > 0;
    if (!is_beyond) return side;
  }
  return std::nullopt;
}

}  // namespace dynalin

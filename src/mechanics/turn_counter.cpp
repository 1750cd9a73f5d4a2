#include "mechanics/turn_counter.h"

#include <cmath>

#include "mechanics/marker_references.h"

namespace dynalin {

double principal_angle(Measure measure, const Matrix3& I, const Matrix3& J) {
  const Frame<double> i{{}, {I.x, I.y, I.z}}, j{{}, {J.x, J.y, J.z}};
  return evaluate_measure<double>(measure, {i, j, j, j});
}

TurnCounter::TurnCounter(const Signals& signals) {
  angles_.reserve(signals.layout().angles.size());
  for (const CountedAngle& a : signals.layout().angles) {
    angles_.push_back({a.measure, frame_of_marker(signals, a.i, Axes::read), frame_of_marker(signals, a.j, Axes::read),
                       static_cast<std::size_t>(a.memory)});
  }
}

void TurnCounter::remember(const Motion& motion, Memory& memory) const {
  for (const Counted& a : angles_) {
    const double angle = principal_angle(a.measure, a.i.axes(motion), a.j.axes(motion));
    double& total = memory[a.memory];
    if (std::isfinite(angle)) total = unwrapped(angle, total);
  }
}

}  // namespace dynalin

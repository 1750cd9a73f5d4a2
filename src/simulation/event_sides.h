// The sides of an event at which a step has ended. Where a function that switches is exactly zero an IF is on neither:
// points right behind and right before it are taken from the step, some roundings away.
#pragma once

#include <optional>
#include <vector>

#include "simulation/consistent_points.h"
#include "simulation/dae_integrator.h"
#include "simulation/events.h"
#include "simulation/motion_unknowns.h"

namespace dynalin {

class EventSides {
 public:
  // All must outlive this.
  EventSides(const System& system, Events& events, const DaeIntegrator& integrator, const MotionUnknowns& unknowns)
      : system_(system),
        events_(events),
        integrator_(integrator),
        unknowns_(unknowns),
        y_(integrator.y().size()),
        yp_(integrator.yp().size()) {}

  // Moves the point, which is where the step has ended, to the side behind.
  void leave(OperatingPoint&);
  // The side before, of a step from `last`; nothing where all that lies between is beyond the event.
  std::optional<OperatingPoint> before(const OperatingPoint& last, const ConsistentPoints&);

 private:
  void take(double t, OperatingPoint&);

  const System& system_;
  Events& events_;
  const DaeIntegrator& integrator_;
  const MotionUnknowns& unknowns_;
  std::vector<double> y_, yp_;
};

}  // namespace dynalin

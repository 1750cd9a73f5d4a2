// Dynamics: a point is led through time by the equations of motion (motion_equations.h). It is consistent on all levels
// at the start, at every output and at the end; between, constraints and their rates are met to the errors that are
// allowed. A step ends where a switch of an element changes its sign, and the integration begins anew there.
#pragma once

#include "analysis/initial.h"
#include "model/settings.h"
#include "simulation/course.h"

namespace dynalin {

struct AdvancedPoint {
  OperatingPoint point;
  SimulationEnd end = SimulationEnd::reached;
};

// `from` is consistent.
Result<AdvancedPoint> advance_dynamics(const System&, OperatingPoint from, const IntegratorSettings&, const Course&);

// Independent velocities that constraints leave at a point.
std::size_t degrees_of_freedom(const System&, const OperatingPoint&);

}  // namespace dynalin

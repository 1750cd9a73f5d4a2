// A point between two that are near each other.
#pragma once

#include "simulation/pose_change.h"

namespace dynalin {

// Positions by the quintic that has the displacement, velocities and accelerations of both, velocities by its rate,
// accelerations by the change of velocities; all that goes with them linearly.
OperatingPoint interpolated(const System&, const OperatingPoint& before, const OperatingPoint& after, double time);

}  // namespace dynalin

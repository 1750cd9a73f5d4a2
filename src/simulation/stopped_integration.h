// Why a run ends in the middle, as far as it can be told.
#pragma once

#include "analysis/initial.h"
#include "simulation/dae_integrator.h"
#include "simulation/motion_equations.h"

namespace dynalin {

// The last point that was accepted, and what led to no further one.
struct StoppedIntegration {
  const System& system;
  const OperatingPoint& point;
  const DaeIntegrator& integrator;
  const MotionEquations& equations;
  double a_little;  // [time], from there to where constraints are tried

  // What the integrator says, what has no value, and whether the constraints can be met at all a little later.
  Failure failure() const;
};

}  // namespace dynalin

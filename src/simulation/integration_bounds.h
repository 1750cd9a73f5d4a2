// What INTEGRATOR asks of a run from one output to the next: which errors steps may have, and how long they may be.
#pragma once

#include "model/settings.h"
#include "simulation/dae_problem.h"
#include "simulation/error_tolerance.h"
#include "simulation/output_times.h"

namespace dynalin {

struct IntegrationBounds {
  IntegrationBounds(const IntegratorSettings&, const OutputTimes&);

  double error;  // ERROR
  ErrorTolerance tolerance;
  StepBounds steps;
};

}  // namespace dynalin

// A course through time, whatever leads it: when it hands points out, who looks at them, and what is told of it.
#pragma once

#include "analysis/initial.h"
#include "simulation/output_times.h"
#include "simulation/simulation_step.h"

namespace dynalin {

struct Course {
  OutputTimes times;
  const SimulationWatch& watch;       // called with every step
  IntegrationStatistics& statistics;  // followed as it goes on
  Findings& findings;
};

}  // namespace dynalin

// What a simulation over time tells while it runs.
#pragma once

#include <cstdint>
#include <functional>

#include "dynalin/simulation.h"
#include "system/system.h"

namespace dynalin {

// An instant of a simulation. The point is consistent on all levels at an output time, and as the integrator has it
// between.
struct SimulationStep {
  const System& system;
  const OperatingPoint& point;
  bool output = false;  // an output time: the start, each step of output, the end
  const IntegrationStatistics& statistics;
};

// Called with every step; a simulation that is not to go on ends there, at a consistent point.
enum class GoOn : bool { no, yes };
using SimulationWatch = std::function<GoOn(const SimulationStep&)>;

}  // namespace dynalin

// What a simulation over time tells while it runs.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

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
  std::string_view text{};  // of SENSORs, for the message file: whole lines
};

// Called with every step; a simulation that is not to go on ends there, at a consistent point.
enum class GoOn : bool { no, yes };
using SimulationWatch = std::function<GoOn(const SimulationStep&)>;

}  // namespace dynalin

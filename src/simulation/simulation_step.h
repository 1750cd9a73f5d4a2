// What a simulation over time tells while it runs.
#pragma once

#include <cstdint>
#include <functional>

#include "system/system.h"

namespace dynalin {

// What an integration has cost so far, and how it goes on.
struct IntegrationStatistics {
  std::int64_t steps = 0, evaluations = 0, jacobians = 0, iterations = 0;
  std::int64_t failed_error_tests = 0, failed_iterations = 0, restarts = 0;
  double step_size = 0;  // [time]
  int order = 0;
};

// An instant of a simulation. The point is consistent on all levels at an output time, and as the integrator has it
// between.
struct SimulationStep {
  const System& system;
  const OperatingPoint& point;
  bool output = false;  // an output time: the start, each step of output, the end
  const IntegrationStatistics& statistics;
};

// How a simulation ended.
enum class SimulationEnd : std::uint8_t {
  reached,   // the end
  returned,  // a SENSOR with RETURN
  halted,    // a SENSOR with HALT: the run ends with it
  stopped,   // by the watch
};

// Called with every step; a simulation that is not to go on ends there, at a consistent point.
enum class GoOn : bool { no, yes };
using SimulationWatch = std::function<GoOn(const SimulationStep&)>;

}  // namespace dynalin

// What a simulation over time tells while it runs.
#pragma once

#include <cstdint>
#include <ctime>
#include <functional>
#include <string_view>

#include "dynalin/simulation.h"
#include "system/system.h"

namespace dynalin {

// Whether an instant is one of output: the start, each step of output, the end.
enum class Instant : bool { between_outputs, output };
inline Instant instant_of(bool is_output) { return is_output ? Instant::output : Instant::between_outputs; }

// An instant of a simulation. The point is consistent on all levels at an output time, and as the integrator has it
// between.
struct SimulationStep {
  const System& system;
  const OperatingPoint& point;
  bool output = false;  // an output time: the start, each step of output, the end
  const IntegrationStatistics& statistics;
  std::string_view text{};  // of SENSORs, for the message file: whole lines
};

// What two integrations have cost, one after the other, and how the later one goes on.
inline IntegrationStatistics followed_by(IntegrationStatistics all, const IntegrationStatistics& later) {
  all.steps += later.steps, all.evaluations += later.evaluations, all.jacobians += later.jacobians;
  all.iterations += later.iterations, all.failed_error_tests += later.failed_error_tests;
  all.failed_iterations += later.failed_iterations, all.restarts += later.restarts;
  all.step_size = later.step_size, all.order = later.order;
  return all;
}

// What expressions see of it from here on.
inline IntegrationProgress progress_of(const IntegrationStatistics& s) {
  return {.processor_time = static_cast<double>(std::clock()) / CLOCKS_PER_SEC,
          .step_size = s.step_size,
          .order = static_cast<double>(s.order),
          .jacobians = static_cast<double>(s.jacobians),
          .evaluations = static_cast<double>(s.evaluations)};
}

// Called with every step; a simulation that is not to go on ends there, at a consistent point.
enum class GoOn : bool { no, yes };
using SimulationWatch = std::function<GoOn(const SimulationStep&)>;

}  // namespace dynalin

// Simulations over time: what is asked of them, what they tell on their way, and what they leave behind.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "dynalin/history.h"
#include "dynalin/operating_point.h"

namespace dynalin {

enum class SimulationKind : std::uint8_t {
  kinematics,     // all motion is prescribed
  dynamics,       // the equations of motion are integrated
  transient,      // dynamics where there are degrees of freedom, else kinematics
  quasi_statics,  // an equilibrium at every output time
};

// How a simulation ended.
enum class SimulationEnd : std::uint8_t {
  reached,   // the end
  returned,  // a SENSOR with RETURN
  halted,    // a SENSOR with HALT: the run ends with it
  stopped,   // by the one who watched it
};

// What an integration has cost so far, and how it goes on.
struct IntegrationStatistics {
  std::int64_t steps = 0, evaluations = 0, jacobians = 0, iterations = 0;
  std::int64_t failed_error_tests = 0, failed_iterations = 0, restarts = 0;
  double step_size = 0;  // [time]
  int order = 0;
};

namespace library {

// An instant of a simulation that runs.
struct SimulationProgress {
  double time = 0;
  bool output = false;  // an output time, at which the point is consistent: the start, each step of output, the end
  IntegrationStatistics statistics;
  std::function<OperatingPoint()> point;  // made when it is asked for; throws once the call is over
};

// A value that is not stated is that of the dataset, or its default.
struct SimulationRequest {
  SimulationKind kind = SimulationKind::dynamics;
  double end = 0;                       // [time], after that of the point
  std::optional<double> output_step{};  // [time] between outputs
  std::optional<std::int64_t> steps{};  // or how many outputs there are behind the start; one if neither is stated
  std::optional<double> error{};        // ERROR of INTEGRATOR: what errors may add up to
  std::optional<double> largest_step{}, first_step{}, least_step{};  // [time]
  std::optional<std::int64_t> largest_order{};
  // Called with every step; the simulation ends there where it returns false.
  std::function<bool(const SimulationProgress&)> watch{};
};

struct Simulation {
  OperatingPoint point;  // where it ended, consistent
  SimulationKind kind;   // what was done: never transient
  SimulationEnd end;
  IntegrationStatistics statistics;
  History history;  // at every output time
};

}  // namespace library
}  // namespace dynalin

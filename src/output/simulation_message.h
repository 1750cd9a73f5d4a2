// Simulations over time in the message file: what is done, about ten rows of how far it is, and the end.
#pragma once

#include <ctime>
#include <iosfwd>
#include <optional>
#include <string>

#include "output/results_steps.h"
#include "simulation/simulation_step.h"

namespace dynalin {

// Seconds as they stand in the last column: "0.02", "1:05", "1:00:07".
std::string seconds_text(double seconds);

struct SimulationHead {
  StepKind kind = StepKind::dynamics;
  double start = 0, end = 0;
  std::optional<double> error = {};                              // of the integration
  std::optional<std::string> integrator = {}, formulation = {};  // as INTEGRATOR names them
};

class SimulationMessage {
 public:
  SimulationMessage(std::ostream&, const SimulationHead&);
  // At any step; it writes a row at the first one and when another tenth of the way is done.
  void add(double time, const IntegrationStatistics&);
  // A row for the last step, unless it has one, and the end.
  void end();

 private:
  void row();

  std::ostream& out_;
  StepKind kind_;
  double start_, end_;
  std::clock_t begun_;
  int tenths_ = -1;  // done, at the last row
  double time_ = 0;
  IntegrationStatistics statistics_;
  bool fresh_ = false;  // since the last row there was a step
};

}  // namespace dynalin

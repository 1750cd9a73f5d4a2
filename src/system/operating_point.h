// All values of a system at one instant, and what it remembers.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mechanics/motion.h"
#include "model/settings.h"

namespace dynalin {

// Velocities and accelerations by coordinates of the layout: v then ω of a part's BCS, global axes.
struct OperatingPoint {
  double time = 0;
  AnalysisMode mode = AnalysisMode::initial_conditions;
  IntegrationProgress progress;
  std::vector<Pose> poses;    // by body, ground first
  std::vector<double> extra;  // coordinates outside bodies
  std::vector<double> velocity, acceleration;
  std::vector<double> lambda;  // multipliers; zero for rows that are not active
  std::vector<double> algebraic;
  std::vector<double> state, state_rate;
  Memory memory;
  std::shared_ptr<const DelayHistories> delays;  // of the motion that led here, null before anything has moved in time
  // How far redundant constraint rows may be from following from the others, in scales of the row: ERROR of IC.
  double redundancy_tolerance = 1e-10;
  // What IC states besides: of the other levels, and of the iterations.
  InitialConditionSettings initial_conditions;
};

// Why an analysis did not deliver: what was tried and what is to blame, by name.
struct Failure {
  std::string analysis;
  std::string message;
  std::vector<std::string> details;
  std::string_view code = {};  // as of a Diagnostic: what `dynalin explain` says more of
};

}  // namespace dynalin

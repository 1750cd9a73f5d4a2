// Whether steps as they have been will ever come to the end of a simulation.
#pragma once

#include <optional>
#include <string>

#include "simulation/output_times.h"
#include "simulation/simulation_step.h"

namespace dynalin {

// What is wrong where, after many steps, so many more are to go that no computer would take them: an end that is far
// beyond what the model does, or steps that are held too short. Steps that grow are believed: the last one counts where
// it is longer than they were.
std::optional<std::string> end_out_of_reach(const OutputTimes&, const SimulationStep&);

}  // namespace dynalin

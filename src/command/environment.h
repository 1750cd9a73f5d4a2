// Environment variables that change what commands do (LINEAR command, 5 and 5.1.12). A variable counts as soon as it is
// set, whatever its value. Nothing below this folder looks at the environment.
#pragma once

#include <string_view>
#include <vector>

namespace dynalin {

struct Environment {
  bool principal_states = false;        // MSC_LINEAR_PBCS_STATES
  bool without_rate_coupling = false;   // MSC_ADAMS_SOLVER_NODAMP_DIFF
  bool without_reconciliation = false;  // MSC_ADAMS_LINEAR_NO_CHECKS_FOR_CONSISTENCY
  bool statics_stay_at_rest = false;    // MSC_ADAMS_STATICS_NO_RESTORE_VELOCITIES

  // Sets a variable by its name, as the command ENVIRONMENT does; false if the name means nothing here.
  bool set(std::string_view name);
  // Names of those that are set.
  std::vector<std::string_view> names() const;
};

// The environment of the process.
Environment read_environment();

}  // namespace dynalin

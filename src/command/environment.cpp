#include "command/environment.h"

#include <cstdlib>

namespace dynalin {

Environment read_environment() {
  Environment e;
  const auto is_set = [&](const char* name) {
    if (!std::getenv(name)) return false;
    e.names.emplace_back(name);
    return true;
  };
  e.principal_states = is_set("MSC_LINEAR_PBCS_STATES");
  e.without_rate_coupling = is_set("MSC_ADAMS_SOLVER_NODAMP_DIFF");
  e.without_reconciliation = is_set("MSC_ADAMS_LINEAR_NO_CHECKS_FOR_CONSISTENCY");
  e.statics_stay_at_rest = is_set("MSC_ADAMS_STATICS_NO_RESTORE_VELOCITIES");
  return e;
}

}  // namespace dynalin

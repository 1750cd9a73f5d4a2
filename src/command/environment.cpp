#include "command/environment.h"

#include <array>
#include <cstdlib>

namespace dynalin {

namespace {

struct Variable {
  const char* name;
  bool Environment::*slot;
};
constexpr std::array variables = {
    Variable{"MSC_LINEAR_PBCS_STATES", &Environment::principal_states},
    Variable{"MSC_ADAMS_SOLVER_NODAMP_DIFF", &Environment::without_rate_coupling},
    Variable{"MSC_ADAMS_LINEAR_NO_CHECKS_FOR_CONSISTENCY", &Environment::without_reconciliation},
    Variable{"MSC_ADAMS_STATICS_NO_RESTORE_VELOCITIES", &Environment::statics_stay_at_rest},
};

}  // namespace

bool Environment::set(std::string_view name) {
  for (const Variable& v : variables) {
    if (v.name == name) return this->*v.slot = true;
  }
  return false;
}

std::vector<std::string_view> Environment::names() const {
  std::vector<std::string_view> list;
  for (const Variable& v : variables) {
    if (this->*v.slot) list.emplace_back(v.name);
  }
  return list;
}

Environment read_environment() {
  Environment e;
  for (const Variable& v : variables) {
    if (std::getenv(v.name)) e.set(v.name);
  }
  return e;
}

}  // namespace dynalin

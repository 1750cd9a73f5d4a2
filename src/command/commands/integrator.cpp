// INTEGRATOR/…: how SIMULATE/DYNAMICS integrates.
#include "command/commands/integrator.h"

namespace dynalin::commands {

std::span<const CommandKind> integrator() {
  static constexpr CommandKind kind =
      setting<Integrator>("INTEGRATOR", "how SIMULATE/DYNAMICS integrates", "INTEGRATOR/GSTIFF, ERROR=1E-4");
  return {&kind, 1};
}

}  // namespace dynalin::commands

// EQUILIBRIUM/…: how SIMULATE/STATICS searches.
#include "command/commands/equilibrium.h"

namespace dynalin::commands {

std::span<const CommandKind> equilibrium() {
  static constexpr CommandKind kind =
      setting<Equilibrium>("EQUILIBRIUM", "how SIMULATE/STATICS searches", "EQUILIBRIUM/MAXIT=100, ALIMIT=5D");
  return {&kind, 1};
}

}  // namespace dynalin::commands

// DEACTIVATE/class, {ID= | RANGE=}: takes elements out of the model.
#include "command/commands/switching.h"

namespace dynalin::commands {

std::span<const CommandKind> deactivate() {
  static const CommandKind kind =
      switching<true>("DEACTIVATE", "takes elements out of the model", "DEACTIVATE/JOINT, RANGE=1,9");
  return {&kind, 1};
}

}  // namespace dynalin::commands

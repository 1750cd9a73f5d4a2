// ACTIVATE/class, {ID= | RANGE=}: takes elements into the model again.
#include "command/commands/switching.h"

namespace dynalin::commands {

std::span<const CommandKind> activate() {
  static const CommandKind kind =
      switching<false>("ACTIVATE", "takes elements into the model again", "ACTIVATE/JOINT, ID=3");
  return {&kind, 1};
}

}  // namespace dynalin::commands

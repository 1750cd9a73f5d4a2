// Commands of the language that are refused by name until they are available.
#include <array>

#include "command/command_kind.h"

namespace dynalin::commands {

namespace {

constexpr CommandKind to_come(std::string_view name, std::string_view summary, std::string_view example) {
  return {.name = name, .use = CommandUse::not_built, .summary = summary, .example = example};
}

constexpr std::array kinds = {
    to_come("CONTROL", "a compiled routine that gives the commands", "CONTROL/FUNCTION=USER(1)"),
    to_come("RELOAD", "goes on from a saved state", "RELOAD/STATES, FILE=saved"),
    to_come("SAVE", "saves a state", "SAVE/STATES, FILE=saved"),
    to_come("SYSTEM", "runs a command of the operating system", "SYSTEM"),
};

}  // namespace

std::span<const CommandKind> not_built() { return kinds; }

}  // namespace dynalin::commands

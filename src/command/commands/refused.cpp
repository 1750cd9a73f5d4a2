// Commands that are refused for good: they hand the run over to something that no reader of the file can see.
#include <array>

#include "command/command_kind.h"

namespace dynalin::commands {

namespace {

constexpr CommandKind refused_for(std::string_view name, std::string_view reason, std::string_view example) {
  return {.name = name, .use = CommandUse::refused, .summary = reason, .example = example};
}

constexpr std::array refused_kinds = {
    refused_for("CONTROL", "a compiled routine would give the commands, and routines are called by statements alone",
                "CONTROL/FUNCTION=USER(1)"),
    refused_for("SYSTEM", "a command file runs no programs of the operating system", "SYSTEM"),
};

}  // namespace

std::span<const CommandKind> refused() { return refused_kinds; }

}  // namespace dynalin::commands

#pragma once

#include "command/command_reader.h"
#include "command/commands.h"

namespace dynalin {

// The arguments of one LINEAR command and the rules between them; reports every one that is broken.
std::optional<LinearCommand> read_linear(ElementReader&);
std::span<const ArgumentInfo> linear_arguments();

}  // namespace dynalin

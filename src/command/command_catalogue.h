// Every command of the language, in the order of the manual.
#pragma once

#include "command/command_kind.h"

namespace dynalin {

std::span<const CommandKind> command_catalogue();
const CommandKind* find_command(std::string_view name);  // by its whole name, nullptr if there is none

}  // namespace dynalin

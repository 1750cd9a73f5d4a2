// LIST of a statement: prints it as it holds when the command runs.
#pragma once

#include "command/command_kind.h"

namespace dynalin::commands {

// The statement of the command's keyword and id; the written one lives as long as the command file.
std::shared_ptr<const CommandAction> list_of_statement(const Statement& written);
void print_statement(const Statement& named, RunState&);

}  // namespace dynalin::commands

// The manual on the terminal. All its text stands in the tables by which the program reads.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "dataset/dataset.h"

namespace dynalin {

// What a statement, command or function of this name is and takes; without a name the list of all of them. Exit status.
int print_help(std::string_view name, std::ostream& out, std::ostream& err);
// The name that a command HELP asks for, empty for none.
std::string help_name(const Statement& help);
// The list of commands.
void print_commands(std::ostream& out);
// What a code of a message means; without a code the list of all codes.
int print_explanation(std::string_view code, std::ostream& out, std::ostream& err);

}  // namespace dynalin

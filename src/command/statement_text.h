// Statements as they hold now, written on lines of their own.
#pragma once

#include <string>

#include "dataset/dataset.h"

namespace dynalin {

// The value of an argument on one line, without comments and marks of continuation.
std::string argument_text(const WrittenArgument&);
// What LIST of a definition command prints: "Current MARKER/12 data are:" and a row for each argument.
std::string statement_list(const Statement&);

}  // namespace dynalin

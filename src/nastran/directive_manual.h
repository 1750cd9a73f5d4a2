// The manual of configuration files, out of the table by which they are read.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

namespace dynalin::nastran {

// All directives and blocks, with what they take; for a terminal.
void print_directives(std::ostream&);
// One of them; false if there is no such name.
bool print_directive(std::string_view name, std::ostream&);
// All of them as sections of docs/nastran.md.
std::string directive_pages();

}  // namespace dynalin::nastran

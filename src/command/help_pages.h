// What the manual says of one statement, command or function.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace dynalin {

// Types of a statement in the order of the catalogue, empty if it has none.
std::vector<std::string_view> types_of(std::string_view statement);

// The page of one type of a statement.
void print_type(std::string_view statement, std::string_view type, std::ostream& out);

// What may stand behind the name of a statement or command, shortened perhaps: types, arguments, classes.
std::vector<std::string_view> names_within(const std::string& name);

// Names one after the other, in as many lines as they need.
void print_names(std::ostream& out, const std::vector<std::string_view>& names, std::string_view indent);

// The pages of everything that has this upper-case name, shortened perhaps, or is a type of that name, or else an
// argument; false if there is nothing.
bool print_pages(const std::string& name, std::ostream& out);

}  // namespace dynalin

// Which forces directives single out.
#pragma once

#include <span>
#include <string_view>

namespace dynalin::nastran {

// Statements with rows in the tables of energies, in lower case and alphabetical order: what they exert has matrices.
std::span<const std::string_view> force_types();

}  // namespace dynalin::nastran

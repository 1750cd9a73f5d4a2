// All kinds of elements the program knows, in the order of the manual.
#pragma once

#include "model/kind.h"

namespace dynalin {

Catalogue catalogue();
// Where a kind of the catalogue stands in the manual: the folder of its source, or "settings and output".
std::string_view catalogue_group(const Kind&);

// Names of statements, each once, in alphabetical order: those of which a command defines arguments anew, the classes
// of elements that commands take out of the model, and settings of analyses.
std::span<const std::string_view> redefinable_statements();
std::span<const std::string_view> deactivatable_statements();
std::span<const std::string_view> setting_statements();

}  // namespace dynalin

// All kinds of elements the program knows, in the order of the manual.
#pragma once

#include "model/kind.h"

namespace dynalin {

Catalogue catalogue();
// Where a kind of the catalogue stands in the manual: the folder of its source, or "without effect".
std::string_view catalogue_group(const Kind&);

}  // namespace dynalin

// All kinds of elements the program knows, in the order of the manual.
#pragma once

#include "model/kind.h"

namespace dynalin {

Catalogue catalogue();

}  // namespace dynalin

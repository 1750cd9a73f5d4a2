// Where elements and functions have no finite value or no derivative.
#pragma once

#include <string>

#include "mechanics/handles.h"

namespace dynalin {

// Why an element has no finite value, or a value without a derivative: a sentence that names it.
struct UndefinedValue {
  const ElementLabel* of = nullptr;
  std::string reason;
  bool in_value = true;
};

}  // namespace dynalin

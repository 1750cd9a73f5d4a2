// Every name of the expression language with its text, gathered from the tables that define the functions.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "expression/function_text.h"

namespace dynalin {

struct FunctionEntry {
  std::string_view name, group;
  FunctionText text;
  std::uint8_t minimum_arguments = 0, maximum_arguments = 0;
  bool built = true;
};

// In the order of the tables, group by group.
const std::vector<FunctionEntry>& function_manual();

}  // namespace dynalin

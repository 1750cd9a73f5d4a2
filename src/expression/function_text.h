// What the manual says of a function of the language; it stands in the row of the table that defines the function.
#pragma once

#include <string_view>

namespace dynalin {

struct FunctionText {
  std::string_view arguments;  // "x, x0, h0": those that may be left out in brackets; empty for a bare name
  std::string_view meaning;    // what the value is, in a line
  std::string_view unit;       // of the value
  std::string_view details;    // the arguments with their units, a line each
};

}  // namespace dynalin

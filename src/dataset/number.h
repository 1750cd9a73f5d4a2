// Decimal numbers as FORTRAN writes them, independent of the locale.
#pragma once

#include <cstddef>
#include <string_view>

namespace dynalin {

enum class ExponentLetter { e, e_or_d };  // D introduces an exponent in matrix files only

// How much of the start of `text` is an unsigned number; 0 if it does not begin with one.
struct NumberExtent {
  std::size_t length = 0;
  bool has_point = false;
  bool has_exponent = false;
};
NumberExtent number_extent(std::string_view text, ExponentLetter letter);

// Value of an unsigned number whose extent is the whole text: infinite if too large, 0 if too
// small.
double number_value(std::string_view text);

}  // namespace dynalin

// FORTRAN formats such as `(3(1PE25.17))` or `( 8F8.5 )`, as far as numbers are read with them.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace dynalin {

struct FortranItem {
  enum class Kind { number, whole_number, skip, next_record, scale };
  Kind kind = Kind::number;
  std::size_t width = 0;
  std::size_t decimals = 0;  // digits behind a point that is not written
  int power = 0;             // of a scale factor, 2P: numbers without exponent are 10^power times what they stand for
  bool fixed = false;        // F, whose numbers are written without exponents

  bool is_number() const { return kind == Kind::number || kind == Kind::whole_number; }
};

// Repetitions are written out. When values remain behind the last item, a new record begins and the format goes on at
// item `again`, the start of the last group in parentheses. A scale factor counts from where it stands until the next
// one does, across records.
struct FortranFormat {
  std::vector<FortranItem> items;
  std::size_t again = 0;
};

// Nothing if the text is no format, or one without numbers.
std::optional<FortranFormat> parse_fortran_format(std::string_view text);

}  // namespace dynalin

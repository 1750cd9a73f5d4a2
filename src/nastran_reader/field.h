// One field of a bulk data card: an integer, a real, a word, or nothing.
#pragma once

#include <string>
#include <string_view>

#include "base/source.h"

namespace dynalin::nastran_reader {

struct Field {
  enum class Form { blank, integer, real, word, wrong };
  Form form = Form::blank;
  std::string text;  // in upper case, without blanks around
  Span at;           // of the text, or of the place where it would stand
  int integer = 0;
  double real = 0;                // of integers as well
  bool double_precision = false;  // written with D
  std::string_view reason;        // why it is wrong

  bool blank() const { return form == Form::blank; }
  bool is_word(std::string_view word) const { return form == Form::word && text == word; }
};

// Integers have no point, reals always have one. Exponents: 7.E+1, 7.D1, and without a letter where a sign stands:
// .7+2.
Field read_field(std::string_view text, const Span& at);

}  // namespace dynalin::nastran_reader

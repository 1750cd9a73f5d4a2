// JSON as text, value by value, laid out as Json::dump(1) lays it out: shapes and tables of many modes as a tree of
// values would take most of the memory and time of a run.
#pragma once

#include <algorithm>
#include <complex>
#include <string>
#include <string_view>
#include <utility>

#include "output/json_values.h"

namespace dynalin {

class JsonText {
 public:
  // What is written stands this deep in the document.
  explicit JsonText(std::size_t depth = 0) : depth_(depth) {}

  void open(char bracket);
  void close(char bracket);
  void element();              // before each value of an array
  void key(std::string_view);  // before each value of an object: plain ASCII
  // A number, null where it is not finite; no negative zero.
  void number(double);
  void complex(std::complex<double>);  // a pair
  void value(const Json&);
  void text(std::string_view written) { text_ += written; }  // a value written at this depth

  std::string take() { return std::exchange(text_, {}); }

 private:
  void next_line() { text_.append(1, '\n').append(depth_, ' '); }

  std::string text_;
  std::size_t depth_;
  bool empty_ = true;  // nothing since the last bracket was opened
};

}  // namespace dynalin

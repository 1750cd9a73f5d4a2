// Which arguments hold raw text (file names, titles, comments) instead of numbers, words or
// expressions.
#pragma once

#include <string_view>

namespace dynalin {

enum class ValueForm {
  tokens,        // numbers, words, expressions
  text,          // raw text up to the comma that ends it
  rest_of_line,  // raw text, commas included
};

// `statement` is the full keyword, `argument` the name as written, perhaps shortened.
ValueForm value_form(std::string_view statement, std::string_view argument);

// Whether `, NAME =` inside a comment that runs to the end of the line still begins an argument.
bool ends_comment(std::string_view name);

}  // namespace dynalin

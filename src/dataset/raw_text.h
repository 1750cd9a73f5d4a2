// Which arguments hold raw text (file names, titles, comments) instead of numbers, words or
// expressions.
#pragma once

#include <string_view>

namespace dynalin {

enum class ValueForm {
  tokens,        // numbers, words, expressions
  text,          // raw text up to the comma that ends it
  rest_of_line,  // raw text, commas included
  text_list,     // texts with commas between them, in quotes or not, any of them empty
  free_text,     // whatever stands there up to the end of the statement, nothing at all included
};

// `statement` is the full keyword, `argument` the name as written, perhaps shortened.
ValueForm value_form(std::string_view statement, std::string_view argument);

// Whether `, NAME =` inside a comment that runs to the end of the line still begins an argument.
bool ends_comment(std::string_view name);

// Whether a bare word behind a list of texts without quotes is an argument of the statement.
bool ends_text_list(std::string_view statement, std::string_view word);

}  // namespace dynalin

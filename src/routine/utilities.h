// What compiled routines call is not called by anything else: whoever loads them asks for it to be linked.
#pragma once

#include <cstddef>
#include <string_view>

namespace dynalin {

void keep_utilities();
void keep_function_utilities();
void keep_data_utilities();
void keep_rotation_utilities();
void keep_text_utilities();
void keep_missing_utilities();

// A text of Fortran, which has a length and blanks behind it.
std::string_view text_of(const char* text, std::size_t length);
// One of C, which may have such blanks.
std::string_view text_of(const char* text);

}  // namespace dynalin

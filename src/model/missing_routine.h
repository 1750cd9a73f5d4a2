// What to do where a dataset calls compiled routines and no library has them: options of the program, and in brackets
// members of ReadingOptions for who calls the library.
#pragma once

#include <string_view>

namespace dynalin::missing_routine {

inline constexpr std::string_view name_a_library =
    "--user-library FILE.so (user_libraries) names a library; no constant can take its place";
inline constexpr std::string_view name_a_library_or_a_value =
    "--user-library FILE.so (user_libraries) names a library, --user-value X (user_value) puts the constant X in the "
    "place of each call";
inline constexpr std::string_view look_into_libraries =
    "--user-library (user_libraries) names libraries; nm -D FILE.so lists what is in one";

}  // namespace dynalin::missing_routine

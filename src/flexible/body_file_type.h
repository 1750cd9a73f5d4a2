// What a file with a flexible body is, by its bytes.
#pragma once

#include <string_view>

namespace dynalin {

// What the first bytes say of a body file.
enum class BodyFileType { modal_text, binary_modal, binary_cache, other_text };
BodyFileType body_file_type(std::string_view bytes);

}  // namespace dynalin

#include "flexible/body_file_type.h"

#include <algorithm>

namespace dynalin {

BodyFileType body_file_type(std::string_view bytes) {
  if (bytes.starts_with("bmod")) return BodyFileType::binary_cache;
  const std::string_view start = bytes.substr(0, 4096);
  const auto strange = [](char c) {
    const auto u = static_cast<unsigned char>(c);
    return u < 32 && c != '\n' && c != '\r' && c != '\t' && c != '\f';
  };
  if (std::any_of(start.begin(), start.end(), strange)) return BodyFileType::binary_modal;
  for (std::size_t at = 0; at < bytes.size();) {
    if (bytes.substr(at).starts_with("** RECORD GROUP 1")) return BodyFileType::modal_text;
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string_view::npos) break;
    at = end + 1;
  }
  return BodyFileType::other_text;
}

}  // namespace dynalin

#include "dataset/tokens.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "dataset/number.h"

namespace dynalin {

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  const auto unprintable = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\t') || byte == 0x7F;
  };
  if (!text.empty() && unprintable(text.front())) {
    return fmt::format("the byte 0x{:02X}", static_cast<unsigned char>(text.front()));
  }
  text = text.substr(0, static_cast<std::size_t>(std::find_if(text.begin(), text.end(), unprintable) - text.begin()));
  if (text.size() <= longest) return fmt::format("'{}'", text);
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return fmt::format("'{}...'", text.substr(0, end));
}

double token_value(const Token& token, const SourceText& source) {
  const std::string_view text = token_text(token, source);
  if (!token.degrees) return number_value(text);
  return number_value(text.substr(0, text.size() - 1)) * std::numbers::pi / 180.0;
}

std::string quoted(const Token& token, const SourceText& source) { return quoted(token_text(token, source)); }

}  // namespace dynalin

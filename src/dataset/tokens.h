// Small questions about tokens, shared by the files of this folder.
#pragma once

#include <string>
#include <string_view>

#include "base/source.h"
#include "dataset/dataset.h"

namespace dynalin {

inline std::string_view token_text(const Token& token, const SourceText& source) {
  return source.text().substr(token.offset, token.length);
}

inline Span token_span(const Token& token, const SourceText& source) { return {&source, token.offset, token.length}; }

inline bool is_symbol(const Token& token, const SourceText& source, char symbol) {
  return token.kind == TokenKind::symbol && token.length == 1 && source.text()[token.offset] == symbol;
}

// Value of a number, in radians where it has the suffix D; infinite if it is too large.
double token_value(const Token& token, const SourceText& source);

// For messages: the token in quotes, shortened if long, or the code of a byte that cannot be
// printed.
std::string quoted(const Token& token, const SourceText& source);
std::string quoted(std::string_view text);

}  // namespace dynalin

#include "command/statement_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace dynalin {

std::string argument_text(const WrittenArgument& w) {
  std::string text;
  const std::string_view source = w.name.source->text();
  const Token* before = nullptr;
  for (const Token& t : w.value()) {
    const std::string_view word = source.substr(t.offset, t.length);
    const bool blank = before && t.offset > before->offset + before->length;
    // Between numbers the mark of a line that continues is their comma; elsewhere it is nothing.
    const bool between_numbers =
        before && before->kind == TokenKind::number && &t != &w.value().back() && ((&t) + 1)->kind != TokenKind::word;
    if (t.continuation) {
      if (between_numbers) text += ",";
      before = &t;
      continue;
    }
    if (blank && !text.empty()) text += " ";
    text += word;
    before = &t;
  }
  return text;
}

std::string statement_list(const Statement& s, const Unstated& unstated) {
  const std::string name = s.id ? fmt::format("{}/{}", s.name, *s.id) : std::string(s.name);
  std::string text = fmt::format("\nCurrent {} data are:\n", name);
  std::size_t width = 0;
  for (const WrittenArgument& w : s.arguments) width = std::max<std::size_t>(width, w.name.length);
  for (const auto& [argument, value] : unstated.values) width = std::max(width, argument.size());
  for (const WrittenArgument& w : s.arguments)
    text += w.has_value ? fmt::format("   {:<{}} = {}\n", w.name.text(), width, argument_text(w))
                        : fmt::format("   {}\n", w.name.text());
  for (const auto& [argument, value] : unstated.values) text += fmt::format("   {:<{}} = {}\n", argument, width, value);
  for (const std::string& sentence : unstated.sentences) text += fmt::format("   {}\n", sentence);
  if (!s.view_name().empty()) text += fmt::format("   its name is {}\n", s.view_name());
  if (s.inactive) text += "   it is not active\n";
  return text + "\n";
}

}  // namespace dynalin

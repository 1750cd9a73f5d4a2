// What the tests of this folder share: reading a text and writing its arguments and diagnostics in
// short form.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dataset/dataset.h"
#include "dataset/tokens.h"

namespace dynalin::testing {

// A dataset with a title line and END around the text, so that the text begins on line 2.
inline Parsed<Dataset> read(const std::string& text) {
  return parse_dataset(std::make_shared<SourceText>("a.adm", "title\n" + text + "\nEND\n"));
}

inline Parsed<Dataset> read_whole(std::string text) {
  return parse_dataset(std::make_shared<SourceText>("a.adm", std::move(text)));
}

// "2:1 unknown-statement": line, column and code of each, warnings included.
inline std::vector<std::string> problems(const Diagnostics& diagnostics) {
  std::vector<std::string> result;
  for (const Diagnostic& item : diagnostics.items()) {
    std::string place = "-";
    if (item.at.source) {
      const SourceText::Place at = item.at.source->place(item.at.offset);
      place = fmt::format("{}:{}", at.line, at.column);
    }
    result.push_back(fmt::format("{} {}", place, item.code));
  }
  return result;
}

// The tokens of a value with one blank between them; continuation marks in angle brackets.
inline std::string value_text(const WrittenArgument& argument, const SourceText& source) {
  std::string text;
  for (const Token& token : argument.value()) {
    if (!text.empty()) text += ' ';
    text += token.continuation ? "<,>" : std::string(token_text(token, source));
  }
  return text;
}

// "NAME", "NAME=value" for each argument.
inline std::vector<std::string> arguments(const Statement& statement, const SourceText& source) {
  std::vector<std::string> result;
  for (const WrittenArgument& argument : statement.arguments) {
    std::string text(argument.name.text());
    if (argument.has_value) text += "=" + value_text(argument, source);
    result.push_back(text);
  }
  return result;
}

inline std::vector<std::string> arguments(const Parsed<Dataset>& parsed, std::size_t statement = 0) {
  return arguments(parsed.value.statements.at(statement), *parsed.value.source);
}

using Texts = std::vector<std::string>;

}  // namespace dynalin::testing

#include "nastran_reader/case_command.h"

#include <cctype>

namespace dynalin::nastran_reader {

namespace {

bool is_text_command(std::string_view name) {
  return name.starts_with("TITL") || name.starts_with("SUBT") || name.starts_with("LABE");
}

bool goes_on(const Line& line) { return upper_trimmed(line.text).ends_with(','); }

}  // namespace

Piece piece(const Line& line, std::string_view part) {
  part = trimmed(part);
  if (part.empty()) return {part, line.span(line.text.size(), 0)};
  return {part, line.span(static_cast<std::size_t>(part.data() - line.text.data()), part.size())};
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> out;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '(') ++depth;
    if (i < text.size() && text[i] == ')') --depth;
    if (i == text.size() || (text[i] == ',' && depth <= 0)) {
      out.push_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
  }
  return out;
}

std::string_view without_equals(std::string_view rest) {
  while (!rest.empty() && (rest[0] == ' ' || rest[0] == '=' || rest[0] == '\t')) rest.remove_prefix(1);
  return rest;
}

bool is_matrix_command(std::string_view name) {
  for (const auto word : {"K2PP", "B2PP", "M2PP", "K2GG", "B2GG", "M2GG"}) {
    if (name == word) return true;
  }
  return false;
}

std::optional<Command> CommandReader::next() {
  while (!lines_.empty()) {
    const Line* line = &lines_.front();
    lines_ = lines_.subspan(1);
    std::optional<Command> command = begun_in(*line);
    if (!command) continue;
    while (!is_text_command(command->name) && goes_on(*line) && !lines_.empty()) {
      line = &lines_.front();
      lines_ = lines_.subspan(1);
      take_values(*line, line->text, *command);
    }
    return command;
  }
  return std::nullopt;
}

void CommandReader::take_values(const Line& line, std::string_view text, Command& to) {
  for (const std::string_view part : split(text)) {
    const Piece p = piece(line, part);
    if (!p.text.empty()) to.values.push_back(p);
  }
}

// Name and values of the first line; options in parentheses change no number.
std::optional<Command> CommandReader::begun_in(const Line& line) {
  Command out;
  const std::string_view text = trimmed(line.text);
  std::size_t i = 0;
  while (i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_')) ++i;
  if (i == 0) {
    diagnostics_.error("case-command", line.span(), "this line of case control begins with no command");
    return std::nullopt;
  }
  out.name = upper_trimmed(text.substr(0, i));
  out.at = piece(line, text.substr(0, i)).at;
  while (i < text.size() && text[i] == ' ') ++i;
  if (i < text.size() && text[i] == '(' && !is_matrix_command(out.name)) {
    const std::size_t close = text.find(')', i);
    if (close == std::string_view::npos) {
      diagnostics_.error("case-command", piece(line, text.substr(i)).at, "the parenthesis is not closed");
      return std::nullopt;
    }
    i = close + 1;
  }
  std::string_view rest = without_equals(text.substr(i));
  if (out.name == "PARAM" || out.name == "SET") {
    while (!rest.empty() && (rest[0] == ',' || rest[0] == ' ')) rest.remove_prefix(1);
  }
  if (out.name == "SET") {
    const std::size_t equals = rest.find('=');
    out.values.push_back(piece(line, rest.substr(0, equals)));
    rest = equals == std::string_view::npos ? std::string_view() : rest.substr(equals + 1);
  }
  if (is_text_command(out.name)) {
    out.values.push_back(piece(line, rest));
  } else {
    take_values(line, rest, out);
  }
  return out;
}

}  // namespace dynalin::nastran_reader

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "command/command_catalogue.h"
#include "command/commands.h"

namespace dynalin {

namespace {

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.front()))) s.remove_prefix(1);
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.back()))) s.remove_suffix(1);
  return s;
}

// Up to the comment behind it.
std::string_view without_comment(std::string_view line) {
  char quote = 0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (quote == 0 && c == '!') return line.substr(0, k);
    if (c == quote)
      quote = 0;
    else if (quote == 0 && (c == '\'' || c == '"'))
      quote = c;
  }
  return line;
}

// Without comments and the marks of lines that continue: & or \ at the end of one, and of two commas one.
std::string one_line(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    std::string_view line = trimmed(without_comment(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!text.empty() && (line.ends_with('&') || line.ends_with('\\'))) line = trimmed(line.substr(0, line.size() - 1));
    if (out.ends_with(',') && line.starts_with(',')) line = trimmed(line.substr(1));
    if (!out.empty() && !line.empty()) out += ' ';
    for (const char c : line) {
      const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
      if (!blank)
        out += c;
      else if (out.back() != ' ')
        out += ' ';
    }
  }
  return out;
}

class FileParser {
 public:
  explicit FileParser(SourceRef source) { file_.source = std::move(source); }

  Parsed<CommandFile> parse(SourceRef commands) {
    Parsed<Dataset> parsed = parse_statements(commands, command_names());
    diagnostics_.append(std::move(parsed.diagnostics));
    keep_ = std::make_shared<Dataset>(std::move(parsed.value));
    file_.written = keep_;
    for (const Statement& s : keep_->statements) {
      if (!s.name.empty()) read(s);
    }
    return {std::move(file_), std::move(diagnostics_)};
  }
  void name_model(std::string model, Span at, std::string prefix) {
    file_.model = std::move(model), file_.model_at = at, file_.output_prefix = std::move(prefix);
  }

 private:
  void read(const Statement& s) {
    const ElementLabel label{s.name, s.id.value_or(0), "", s.at};
    CommandReader reader(s, *keep_->source, diagnostics_, label);
    Span whole = s.at;
    if (!s.arguments.empty()) {
      const WrittenArgument& last = s.arguments.back();
      whole = join(s.at, last.has_value && last.value_span().length > 0 ? last.value_span() : last.name);
    }
    const CommandKind& kind = *find_command(s.name);
    if (!kind.read) {
      diagnostics_.error("refused-command", s.keyword(), fmt::format("{} is refused: {}", s.name, kind.summary));
      return;
    }
    auto action = kind.read(reader);
    Command command;
    command.text = one_line(whole.text()), command.at = s.at, command.whole = whole;
    command.statement = &s, command.kind = &kind;
    command.action = std::move(action), command.written = file_.written;
    file_.commands.push_back(std::move(command));
  }

  CommandFile file_;
  Diagnostics diagnostics_;
  std::shared_ptr<Dataset> keep_;
};

// Without a comment, which names may not look like: "car ! of 2019".
std::string_view uncommented(std::string_view line) {
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '!' && (k == 0 || std::isspace(static_cast<unsigned char>(line[k - 1])))) return line.substr(0, k);
  }
  return line;
}

// A name that stands in quotes, as those with blanks may.
std::string_view unquoted(std::string_view name) {
  const bool quoted = name.size() > 2 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front();
  return quoted ? name.substr(1, name.size() - 2) : name;
}

bool is_command_line(std::string_view line) {
  if (line.empty()) return true;
  const std::size_t slash = line.find('/');
  const std::string_view word = trimmed(line.substr(0, slash));
  return (slash != std::string_view::npos && find_keyword(word, command_names()).has_value()) ||
         (word.size() >= 3 && find_keyword(word, std::array<std::string_view, 1>{"STOP"}));  // a model may be called s
}

// Whether a line is a SIMULATE or LINEAR that would run, and no path that merely looks like a command.
bool is_analysis(const std::string& line) {
  if (!is_command_line(line)) return false;
  const Parsed<CommandFile> parsed = parse_commands(std::make_shared<const SourceText>("", line));
  if (parsed.diagnostics.has_errors() || parsed.value.commands.empty()) return false;
  return parsed.value.commands.front().kind->use == CommandUse::analysis;
}

// Whether a line is a command beyond doubt: out/run_1 may be a prefix.
bool is_command(const std::string& line) {
  if (line.empty() || !is_command_line(line)) return line.empty();
  const Parsed<CommandFile> parsed = parse_commands(std::make_shared<const SourceText>("", line));
  const auto& commands = parsed.value.commands;
  return !parsed.diagnostics.has_errors() || (!commands.empty() && commands.front().kind->use == CommandUse::analysis);
}

// Behind the line of the model and comments. Where a command follows those, they stand in the place of an empty prefix.
std::size_t line_of_prefix(const SourceText& source, std::size_t named) {
  std::size_t n = named + 1;
  while (n <= source.line_count() && trimmed(source.line(n)).starts_with('!')) ++n;
  if (n == named + 1) return n;
  return n <= source.line_count() && !is_command(std::string(trimmed(uncommented(source.line(n))))) ? n : named + 1;
}

}  // namespace

Parsed<CommandFile> parse_command_file(SourceRef source) {
  FileParser parser(source);
  std::size_t named = 1;  // the line of the model, behind comments
  while (named < source->line_count() && trimmed(source->line(named)).starts_with('!')) ++named;
  const std::string_view first = trimmed(uncommented(source->line(named)));
  if (source->text().empty() || is_command_line(first)) return parser.parse(source);

  // Model and prefix stand on lines of their own; blank them out so that the rest keeps its places.
  const std::size_t prefix_line = line_of_prefix(*source, named);
  std::string text(source->text());
  for (const std::size_t n : {named, prefix_line}) {
    if (n > source->line_count()) continue;
    const std::string_view line = source->line(n);
    text.replace(static_cast<std::size_t>(line.data() - source->text().data()), line.size(), line.size(), ' ');
  }
  const auto offset = static_cast<std::uint32_t>(first.data() - source->text().data());
  const std::string prefix(prefix_line <= source->line_count()
                               ? unquoted(trimmed(uncommented(source->line(prefix_line))))
                               : std::string_view());
  parser.name_model(std::string(unquoted(first)), {source.get(), offset, static_cast<std::uint32_t>(first.size())},
                    prefix);
  auto rest = std::make_shared<const SourceText>(source->name(), std::move(text));
  Parsed<CommandFile> file = parser.parse(rest);
  if (is_analysis(prefix)) {
    const std::string_view line = source->line(prefix_line);
    const auto at = static_cast<std::uint32_t>(line.data() - source->text().data() +
                                               static_cast<std::ptrdiff_t>(line.find(prefix)));
    file.diagnostics.error("missing-prefix", {source.get(), at, static_cast<std::uint32_t>(prefix.size())},
                           "the line behind the model is the prefix of the output files, and here it is a command",
                           "put a prefix above it, or an empty line to take the name of the dataset");
  }
  file.value.source = rest;
  return file;
}

Parsed<CommandFile> parse_commands(SourceRef source) { return FileParser(source).parse(source); }

}  // namespace dynalin

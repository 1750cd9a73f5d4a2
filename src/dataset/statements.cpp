// Reads datasets and command files statement by statement.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <limits>
#include <utility>

#include "dataset/arguments.h"
#include "dataset/characters.h"
#include "dataset/dataset.h"
#include "dataset/lexer.h"
#include "dataset/tokens.h"

namespace dynalin {

namespace {

enum class Language { dataset, commands };

constexpr std::size_t most_errors = 1000;  // a file with more is not what it seems to be
constexpr std::size_t longest_title = 80;
constexpr std::size_t documented_id_digits = 8;

// The one name that has the word in it: ACCGRAV for GRAV. "" where several have.
std::string_view only_with(std::string_view word, std::span<const std::string_view> names) {
  constexpr std::size_t enough = 4;
  if (word.size() < enough) return {};
  const std::string part = upper_case(word);
  std::string_view one;
  for (const std::string_view name : names) {
    if (name.find(part) == std::string_view::npos) continue;
    if (!one.empty()) return {};
    one = name;
  }
  return one;
}

class StatementReader {
 public:
  StatementReader(Language language, SourceRef source, std::span<const std::string_view> keywords)
      : language_(language), keywords_(keywords), text_(*source) {
    dataset_.source = std::move(source);
  }

  void read(std::uint32_t start);
  void read_title();
  void report_missing_end();
  bool check_is_text();
  bool stopped() const { return ended_ || diagnostics_.error_count() >= most_errors; }
  std::uint32_t start() const { return start_; }
  Parsed<Dataset> finish() { return {std::move(dataset_), std::move(diagnostics_)}; }

 private:
  std::string_view first_line() const { return text_.text().substr(0, text_.text().find_first_of("\r\n")); }
  bool first_line_is_statement() const;
  bool is_end(std::span<const Token> tokens) const;
  void report_text_behind_end(std::span<const Token> tokens);
  void read_statement(std::span<const Token> tokens, std::string_view view_name);
  bool is_statement(std::span<const Token> tokens);
  void report_not_a_statement(std::span<const Token> tokens);
  std::string continuation_hint(std::span<const Token> tokens);
  std::string other_language_hint(std::string_view word) const;
  void look_up(Statement& statement);
  std::size_t read_id(std::span<const Token> tokens, Statement& statement);
  void read_arguments(std::span<const Token> tokens, Statement& statement);

  Language language_;
  std::span<const std::string_view> keywords_;
  const SourceText& text_;
  Dataset dataset_;
  Diagnostics diagnostics_;
  SplitArguments split_;  // of the statement in hand
  std::uint32_t start_ = 0;
  bool ended_ = false;
  bool last_is_open_ = false;  // the last statement ends in a comma or an operator
  std::string_view known_word_, known_name_;
};

bool StatementReader::check_is_text() {
  const std::string_view text = text_.text();
  constexpr std::string_view blanks = " \t\f\v\r\n";
  const Span first{&text_, 0, 0};
  const bool utf16 = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  const std::string_view sample = text.substr(0, 1024);
  const auto zeros = std::count(sample.begin(), sample.end(), '\0');
  if (utf16 || zeros * 8 > static_cast<std::ptrdiff_t>(sample.size())) {
    diagnostics_.error("not-text", first, utf16 ? "the file is UTF-16 text" : "the file holds binary data",
                       "a dataset or command file is plain ASCII or UTF-8 text");
    return false;
  }
  if (language_ == Language::dataset && text.find_first_not_of(blanks) == std::string_view::npos) {
    diagnostics_.error("empty-dataset", first, "the dataset is empty");
    return false;
  }
  return true;
}

// Strict, because titles such as `P/N 1234, rear axle` look like statements.
bool StatementReader::first_line_is_statement() const {
  Lexer lexer(text_, 0);
  std::vector<Token> tokens;
  if (!lexer.next_statement(tokens) || tokens[0].offset >= first_line().size()) return false;
  if (tokens.size() < 2 || tokens[0].kind != TokenKind::word) return false;
  const std::string_view word = token_text(tokens[0], text_);
  if (!is_symbol(tokens[1], text_, '/') || statement_name(word).empty()) return false;
  if (tokens.size() == 2 || tokens[2].continuation) return true;
  const bool ends = tokens.size() == 3 || is_symbol(tokens[3], text_, ',');
  if (tokens[2].kind == TokenKind::number) return tokens[2].integer && ends;
  if (tokens[2].kind != TokenKind::word) return false;
  return (ends && word.size() >= 3) || (tokens.size() > 3 && is_symbol(tokens[3], text_, '='));
}

void StatementReader::read_title() {
  if (first_line_is_statement()) {
    const std::size_t length = first_line().size();
    diagnostics_.warning("missing-title", {&text_, 0, static_cast<std::uint32_t>(length)},
                         "the first line should be the title and is read as a statement",
                         "put a line with a title before it");
    return;
  }
  std::string_view title = first_line();
  start_ = static_cast<std::uint32_t>(title.size());
  std::size_t end = std::min(title.size(), longest_title);
  // A character of several bytes is kept whole or not at all.
  while (end < title.size() && end > 0 && (static_cast<unsigned char>(title[end]) & 0xC0) == 0x80) {
    --end;
  }
  title = title.substr(0, end);
  while (!title.empty() && is_blank(title.back())) title.remove_suffix(1);
  dataset_.title = title;
}

void StatementReader::read(std::uint32_t start) {
  Lexer lexer(text_, start);
  std::vector<Token> tokens;
  while (!stopped() && lexer.next_statement(tokens)) {
    if (is_end(tokens)) {
      // Text behind STOP is a remark; an id or arguments are what nobody can give it.
      const bool asks = tokens.size() > 2 && is_symbol(tokens[1], text_, '/');
      if (language_ == Language::commands)
        read_statement(std::span(tokens).first(asks ? tokens.size() : 1), lexer.view_name());
      else if (asks)
        report_text_behind_end(tokens);
      ended_ = true;
      return;
    }
    read_statement(tokens, lexer.view_name());
    const Token& last = tokens.back();
    last_is_open_ = last.kind == TokenKind::symbol && !is_symbol(last, text_, ')') && !is_symbol(last, text_, ']') &&
                    !is_symbol(last, text_, '\\') && !is_symbol(last, text_, '/');
  }
  if (diagnostics_.error_count() >= most_errors) {
    diagnostics_.error("too-many-errors", {&text_, lexer.position(), 0},
                       fmt::format("reading stops here after {} errors", most_errors));
  }
}

// Nothing behind the end is read, whatever it is.
bool StatementReader::is_end(std::span<const Token> tokens) const {
  if (language_ == Language::commands) {
    const auto found = find_keyword(token_text(tokens[0], text_), keywords_);
    return tokens[0].kind == TokenKind::word && found && keywords_[*found] == "STOP";
  }
  if (!equal_ignoring_case(token_text(tokens[0], text_), "END")) return false;
  return tokens.size() == 1 || is_symbol(tokens[1], text_, '/');
}

void StatementReader::report_text_behind_end(std::span<const Token> tokens) {
  const Span behind = join(token_span(tokens[2], text_), token_span(tokens.back(), text_));
  diagnostics_.error("unexpected-text", behind,
                     fmt::format("END has no id and no arguments, found {}", quoted(behind.text())),
                     "END ends the dataset: a statement with a longer name may have lost its letters");
}

void StatementReader::report_missing_end() {
  if (stopped()) return;
  const std::size_t last = text_.text().find_last_not_of(" \t\f\v\r\n");
  diagnostics_.warning("missing-end", {&text_, static_cast<std::uint32_t>(last + 1), 0},
                       "the dataset has no END statement", "the end of the file may be lost");
}

void StatementReader::read_statement(std::span<const Token> tokens, std::string_view view_name) {
  if (!is_statement(tokens)) return;
  Statement& statement = dataset_.statements.emplace_back();
  statement.at = token_span(tokens[0], text_);
  statement.keyword_length = statement.at.length;
  if (!view_name.empty()) {
    statement.view_name_offset = static_cast<std::uint32_t>(view_name.data() - text_.text().data());
    statement.view_name_length = static_cast<std::uint32_t>(view_name.size());
  }
  look_up(statement);

  std::size_t next = 1;
  if (tokens.size() > 1 && is_symbol(tokens[1], text_, '/')) {
    next = 2 + read_id(tokens.subspan(2), statement);
  }
  read_arguments(tokens.subspan(next), statement);
}

bool StatementReader::is_statement(std::span<const Token> tokens) {
  const bool word = tokens[0].kind == TokenKind::word;
  const bool slash = tokens.size() > 1 && is_symbol(tokens[1], text_, '/');
  if (word && slash) return true;
  if (word && language_ == Language::commands) {
    if (tokens.size() == 1 || tokens[1].kind == TokenKind::word) return true;
    if (is_symbol(tokens[1], text_, ',')) return true;
  }
  report_not_a_statement(tokens);
  return false;
}

void StatementReader::report_not_a_statement(std::span<const Token> tokens) {
  const Token& first = tokens[0];
  const Span at = token_span(first, text_);
  if (is_symbol(first, text_, ',')) {
    diagnostics_.error("stray-continuation", at, "there is no statement that this line continues");
    return;
  }
  const std::string found = quoted(first, text_);
  if (first.kind == TokenKind::other && !found.starts_with('\'')) {
    diagnostics_.error("bad-character", at, found + " begins a statement");
    return;
  }
  // The whole line is marked, and not the lines that continue it.
  const std::size_t line_end = std::min(text_.text().find_first_of("\r\n", first.offset), text_.text().size());
  Span line = at;
  for (const Token& token : tokens) {
    if (token.offset < line_end) line = join(line, token_span(token, text_));
  }
  diagnostics_.error(
      "not-a-statement", line,
      fmt::format("{} is not {}", quoted(line.text()), language_ == Language::dataset ? "a statement" : "a command"),
      continuation_hint(tokens));
}

std::string StatementReader::continuation_hint(std::span<const Token> tokens) {
  if (language_ == Language::commands) return "a command begins with its keyword";
  if (last_is_open_ && !dataset_.statements.empty()) {
    dataset_.statements.back().damaged = true;  // what it lacks stands here
    return fmt::format("begin the line with a comma if it continues {}", dataset_.statements.back().at.text());
  }
  const std::string_view word = token_text(tokens[0], text_);
  if (tokens.size() == 1 && tokens[0].kind == TokenKind::word) {
    if (std::string hint = other_language_hint(word); !hint.empty()) return hint;
  }
  if (tokens.size() > 1 && tokens[1].kind == TokenKind::number && !statement_name(word).empty()) {
    return fmt::format("write {}/{}", word, token_text(tokens[1], text_));
  }
  return "a comment begins with '!', a line that continues a statement with a comma";
}

// A word of the other language, or a command that has no place among those taken here: nothing for what is neither, or
// hardly a word.
std::string StatementReader::other_language_hint(std::string_view word) const {
  constexpr std::size_t enough = 3;
  const bool dataset = language_ == Language::dataset;
  if (!dataset && word.size() >= enough) {
    if (const auto command = find_keyword(word, command_names()))
      return std::string(command_names()[*command]) + " is a command that changes no model";
  }
  const std::span<const std::string_view> names = dataset ? command_names() : statement_names();
  const auto found = word.size() < enough ? std::nullopt : find_keyword(word, names);
  if (!found) return {};
  return std::string(names[*found]) + (dataset ? " is a command: it belongs in a command file, or behind -c"
                                               : " is a statement: it belongs in the dataset");
}

void StatementReader::look_up(Statement& statement) {
  const std::string_view word = statement.keyword().text();
  // Statements of one kind stand together.
  if (word == known_word_) {
    statement.name = known_name_;
    return;
  }
  std::vector<std::string_view> ambiguous;
  const std::optional<std::size_t> found = find_keyword(word, keywords_, &ambiguous);
  if (found) {
    statement.name = known_name_ = keywords_[*found];
    known_word_ = word;
    return;
  }
  statement.damaged = true;
  const std::string_view noun = language_ == Language::dataset ? "statement" : "command";
  if (!ambiguous.empty()) {
    std::string list;
    for (std::size_t i = 0; i < ambiguous.size(); ++i) {
      if (i > 0) list += i + 1 < ambiguous.size() ? ", " : " or ";
      list += ambiguous[i];
    }
    diagnostics_.error("ambiguous-keyword", statement.keyword(),
                       fmt::format("{} may mean several {}s", quoted(word), noun), fmt::format("it could be {}", list));
    return;
  }
  std::string_view nearest = nearest_word(word, keywords_);
  if (nearest.empty()) nearest = only_with(word, keywords_);
  std::string hint = other_language_hint(word);
  static constexpr std::array<std::string_view, 2> endings = {"QUIT", "EXIT"};
  const auto ends = [&](std::string_view ending) { return equal_ignoring_case(word, ending); };
  if (language_ != Language::dataset && std::ranges::any_of(endings, ends)) hint = "STOP ends the run";
  if (language_ == Language::dataset && ends("ADAMS")) hint = "a title is the first line of the file, of whatever kind";
  if (hint.empty() && !nearest.empty()) hint = fmt::format("did you mean {}?", nearest);
  diagnostics_.error(language_ == Language::dataset ? "unknown-statement" : "unknown-command", statement.keyword(),
                     fmt::format("there is no {} {}", noun, quoted(word)), std::move(hint));
}

// Reads the id if there is one; returns how many tokens belong to it.
std::size_t StatementReader::read_id(std::span<const Token> tokens, Statement& statement) {
  if (tokens.empty()) return 0;
  const bool sign = is_symbol(tokens[0], text_, '-') || is_symbol(tokens[0], text_, '+');
  const std::size_t number = sign ? 1 : 0;
  if (number >= tokens.size() || tokens[number].kind != TokenKind::number) return 0;
  std::size_t count = number + 1;
  const auto touches = [&](std::size_t i) {
    return tokens[i].kind != TokenKind::symbol && tokens[i].offset == tokens[i - 1].offset + tokens[i - 1].length;
  };
  while (count < tokens.size() && touches(count)) ++count;
  const Span at = join(token_span(tokens[0], text_), token_span(tokens[count - 1], text_));
  statement.at = join(statement.keyword(), at);

  std::string_view digits = at.text();
  while (digits.size() > 1 && digits.front() == '0') digits.remove_prefix(1);
  std::int64_t id = 0;
  const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), id);
  const bool whole = count == 1 && tokens[0].integer;
  const bool fits = parsed.ec == std::errc{} && id <= std::numeric_limits<std::int32_t>::max();
  if (!whole || !fits || id == 0) {
    statement.damaged = true;
    if (statement.name.empty()) return count;
    diagnostics_.error("bad-id", at,
                       fmt::format("an id is a positive whole number{}, found {}",
                                   whole && !fits ? " up to 2147483647" : "", quoted(at.text())));
    return count;
  }
  statement.id = static_cast<std::int32_t>(id);
  if (digits.size() > documented_id_digits) {
    diagnostics_.warning(
        "long-id", at, fmt::format("the id of {} has more than {} digits", statement.at.text(), documented_id_digits));
  }
  return count;
}

void StatementReader::read_arguments(std::span<const Token> tokens, Statement& statement) {
  Diagnostics ignored;  // of an unknown statement, which has its one error already
  split_arguments(tokens, statement.name, text_, statement.name.empty() ? ignored : diagnostics_, split_);
  statement.damaged = statement.damaged || split_.damaged;
  for (WrittenArgument& argument : split_.arguments) {
    if (!argument.value().empty()) argument.set_value(dataset_.tokens.add(argument.value()));
  }
  statement.arguments = WrittenArguments(split_.arguments, *dataset_.memory);
}

}  // namespace

Parsed<Dataset> parse_dataset(SourceRef source) {
  assert(source);
  StatementReader reader(Language::dataset, std::move(source), statement_names());
  if (reader.check_is_text()) {
    reader.read_title();
    reader.read(reader.start());
    reader.report_missing_end();
  }
  return reader.finish();
}

Parsed<Dataset> parse_statements(SourceRef source, std::span<const std::string_view> keywords, std::uint32_t start) {
  assert(source && start <= source->text().size());
  StatementReader reader(Language::commands, std::move(source), keywords);
  if (reader.check_is_text()) reader.read(start);
  return reader.finish();
}

}  // namespace dynalin

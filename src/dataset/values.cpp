// Reads the value of one argument as numbers, words or text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "dataset/dataset.h"
#include "dataset/tokens.h"

namespace dynalin {

namespace {

struct WrittenReal {
  double value;
  bool integer;
  Span at;
};

std::string_view name_of(const WrittenArgument& argument) { return argument.name.text(); }

// So many numbers, or any number of them.
struct Wanted {
  std::size_t count = 0;  // 0: any
  std::string_view noun = "number";

  explicit operator std::string() const {
    return count == 0   ? fmt::format("{}s", noun)
           : count == 1 ? fmt::format("one {}", noun)
                        : fmt::format("{} {}s", count, noun);
  }
};

// False if there is nothing to read, which is reported here unless it was before. What is wanted becomes a text only
// then.
template <class What>
bool has_readable_value(const WrittenArgument& argument, const What& what, Diagnostics& diagnostics) {
  if (argument.damaged) return false;
  if (argument.has_value && !argument.value().empty()) return true;
  diagnostics.error("missing-value", argument.name, fmt::format("{} needs {}", name_of(argument), std::string(what)),
                    fmt::format("write {} = ...", name_of(argument)));
  return false;
}

// Numbers with commas between them, one after the other. Whoever reads it goes on as far as it can, so that the first
// thing wrong is reported.
class NumberList {
 public:
  NumberList(const WrittenArgument& argument, const SourceText& source, Diagnostics& diagnostics)
      : argument_(argument), source_(source), diagnostics_(diagnostics) {}

  bool at_end() const { return at_ == tokens().size(); }

  std::optional<WrittenReal> read_number() {
    const std::size_t begin = at_;
    const bool negative = symbol_here('-');
    if (negative || symbol_here('+')) ++at_;
    if (at_ == tokens().size() || symbol_here(',')) {
      report_missing(begin);
      return std::nullopt;
    }
    const Token& token = tokens()[at_];
    const Span at = token_span(token, source_);
    if (token.kind != TokenKind::number) {
      diagnostics_.error("expected-number", at,
                         fmt::format("{} takes plain numbers, found {}", name_of(argument_), quoted(token, source_)),
                         symbol_here('(') ? "lists have no parentheses: QP=1, 2, 3" : "");
      return std::nullopt;
    }
    const double value = token_value(token, source_);
    // Too large a number was reported with the statement, and its argument marked.
    if (!std::isfinite(value)) return std::nullopt;
    ++at_;
    return WrittenReal{negative ? -value : value, token.integer, join(token_span(tokens()[begin], source_), at)};
  }

  // A comma at the end of a line and the mark at the start of the next are one.
  bool read_comma() {
    if (symbol_here(',')) {
      ++at_;
      while (at_ < tokens().size() && tokens()[at_].continuation) ++at_;
      return true;
    }
    const Token& token = tokens()[at_];
    const bool number = token.kind == TokenKind::number;
    diagnostics_.error(
        number ? "expected-comma" : "expected-number", token_span(token, source_),
        number ? fmt::format("a comma is missing before {}", quoted(token, source_))
               : fmt::format("{} takes plain numbers, found {}", name_of(argument_), quoted(token, source_)),
        hint_for(token));
    return false;
  }

 private:
  std::span<const Token> tokens() const { return argument_.value(); }
  bool symbol_here(char symbol) const { return at_ < tokens().size() && is_symbol(tokens()[at_], source_, symbol); }

  void report_missing(std::size_t begin) {
    const Token& token = tokens()[std::min(begin, tokens().size() - 1)];
    diagnostics_.error("missing-value", token_span(token, source_),
                       fmt::format("a number is missing in the list of {}", name_of(argument_)));
  }

  // What stands behind a number without a comma.
  const char* hint_for(const Token& token) const {
    const std::string_view word = token_span(token, source_).text();
    const bool exponent = word.size() > 1 && (word[0] == 'd' || word[0] == 'D') &&
                          std::all_of(word.begin() + 1, word.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (exponent) return "D behind a number means degrees; the letter of an exponent is E";
    const bool is_word = token.kind == TokenKind::word;
    return is_word ? "units are not written behind numbers; UNITS states them for the whole dataset" : "";
  }

  const WrittenArgument& argument_;
  const SourceText& source_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
};

// take(number) for each; false if anything is wrong, which is reported.
template <class Take>
bool read_numbers(const WrittenArgument& argument, const SourceText& source, Diagnostics& diagnostics,
                  const Wanted& wanted, const Take& take) {
  if (!has_readable_value(argument, wanted, diagnostics)) return false;
  NumberList list(argument, source, diagnostics);
  std::size_t found = 0;
  for (;;) {
    const std::optional<WrittenReal> number = list.read_number();
    if (!number) return false;
    take(*number);
    ++found;
    if (list.at_end()) break;
    if (!list.read_comma()) return false;
  }
  if (wanted.count == 0 || found == wanted.count) return true;
  diagnostics.error("wrong-count", argument.value_span(),
                    fmt::format("{} takes {}, found {}", name_of(argument), std::string(wanted), found));
  return false;
}

// Whole numbers may be written as reals without fraction.
std::optional<WrittenInteger> as_integer(const WrittenArgument& argument, const WrittenReal& number,
                                         Diagnostics& diagnostics) {
  constexpr double exact = 9007199254740992.0;  // 2^53: beyond it neighbours coincide
  const bool degrees = !number.integer && number.at.text().find_first_of("dD") != std::string_view::npos;
  if (!degrees && std::abs(number.value) <= exact && number.value == std::floor(number.value)) {
    return WrittenInteger{static_cast<std::int64_t>(number.value), number.at};
  }
  diagnostics.error("expected-integer", number.at,
                    fmt::format("{} takes whole numbers, found {}", name_of(argument), quoted(number.at.text())));
  return std::nullopt;
}

// One word, which may begin with digits (3DBEAM) as long as no blank stands in it.
std::optional<Span> take_word(const WrittenArgument& argument, const SourceText& source, Diagnostics& diagnostics,
                              std::size_t& at) {
  const std::span<const Token> tokens = argument.value();
  while (at < tokens.size() && tokens[at].continuation) ++at;
  if (at == tokens.size()) {
    diagnostics.error("missing-value", token_span(tokens.back(), source),
                      fmt::format("a word is missing in the list of {}", name_of(argument)));
    return std::nullopt;
  }
  Span word = token_span(tokens[at], source);
  bool has_letters = false;
  const std::size_t begin = at;
  while (at < tokens.size()) {
    const Token& token = tokens[at];
    if (token.kind != TokenKind::word && token.kind != TokenKind::number) break;
    if (at > begin && token.offset != word.offset + word.length) break;
    has_letters = has_letters || token.kind == TokenKind::word;
    word = join(word, token_span(token, source));
    ++at;
  }
  if (has_letters) return word;
  diagnostics.error("expected-word", word,
                    fmt::format("{} takes a word, found {}", name_of(argument), quoted(word.text())));
  return std::nullopt;
}

void report_not_a_word(const WrittenArgument& argument, const Token& token, const SourceText& source,
                       std::string_view takes, Diagnostics& diagnostics) {
  diagnostics.error(
      "expected-word", token_span(token, source),
      fmt::format("{} takes {}, found {} behind the first", name_of(argument), takes, quoted(token, source)));
}

}  // namespace

std::optional<double> read_real(const WrittenArgument& argument, const SourceText& source, Diagnostics& diagnostics) {
  double value = 0;
  const auto take = [&](const WrittenReal& number) { value = number.value; };
  if (!read_numbers(argument, source, diagnostics, {1}, take)) return std::nullopt;
  return value;
}

std::optional<std::vector<double>> read_reals(const WrittenArgument& argument, const SourceText& source,
                                              Diagnostics& diagnostics, std::size_t count) {
  std::vector<double> values;
  values.reserve((argument.value().size() + 1) / 2);  // a comma behind each but the last
  const auto take = [&](const WrittenReal& number) { values.push_back(number.value); };
  if (!read_numbers(argument, source, diagnostics, {count}, take)) return std::nullopt;
  return values;
}

std::optional<WrittenInteger> read_integer(const WrittenArgument& argument, const SourceText& source,
                                           Diagnostics& diagnostics) {
  WrittenReal number{};
  const auto take = [&](const WrittenReal& read) { number = read; };
  if (!read_numbers(argument, source, diagnostics, {1, "whole number"}, take)) return std::nullopt;
  return as_integer(argument, number, diagnostics);
}

std::optional<std::vector<WrittenInteger>> read_integers(const WrittenArgument& argument, const SourceText& source,
                                                         Diagnostics& diagnostics) {
  std::vector<WrittenReal> numbers;
  const auto take = [&](const WrittenReal& number) { numbers.push_back(number); };
  if (!read_numbers(argument, source, diagnostics, {0, "whole number"}, take)) return std::nullopt;
  std::vector<WrittenInteger> values;
  values.reserve(numbers.size());
  for (const WrittenReal& number : numbers) {
    const auto value = as_integer(argument, number, diagnostics);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::optional<Span> read_word(const WrittenArgument& argument, const SourceText& source, Diagnostics& diagnostics) {
  if (!has_readable_value(argument, "a word", diagnostics)) return std::nullopt;
  std::size_t at = 0;
  const std::optional<Span> word = take_word(argument, source, diagnostics, at);
  if (!word || at == argument.value().size()) return word;
  report_not_a_word(argument, argument.value()[at], source, "one word", diagnostics);
  return std::nullopt;
}

std::optional<std::vector<Span>> read_words(const WrittenArgument& argument, const SourceText& source,
                                            Diagnostics& diagnostics) {
  if (!has_readable_value(argument, "words", diagnostics)) return std::nullopt;
  std::vector<Span> words;
  std::size_t at = 0;
  for (;;) {
    const std::optional<Span> word = take_word(argument, source, diagnostics, at);
    if (!word) return std::nullopt;
    words.push_back(*word);
    while (at < argument.value().size() && argument.value()[at].continuation) ++at;
    if (at == argument.value().size()) return words;
    if (!is_symbol(argument.value()[at], source, ':')) break;
    ++at;
  }
  report_not_a_word(argument, argument.value()[at], source, "words with colons between them", diagnostics);
  return std::nullopt;
}

std::optional<std::string> read_text(const WrittenArgument& argument, const SourceText&, Diagnostics& diagnostics) {
  if (!has_readable_value(argument, "a text", diagnostics)) return std::nullopt;
  std::string_view text = argument.value_span().text();
  const bool in_quotes = text.size() >= 2 && (text.front() == '\'' || text.front() == '"') &&
                         text.find(text.front(), 1) == text.size() - 1;
  if (in_quotes) text = text.substr(1, text.size() - 2);
  return std::string(text);
}

}  // namespace dynalin

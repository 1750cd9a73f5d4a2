// The statements of a dataset or command file as written: keyword, id, arguments and where each stands.
// Knows the grammar of text, and nothing of mechanics.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/block_memory.h"
#include "base/diagnostics.h"
#include "base/source.h"
#include "dataset/written_arguments.h"

namespace dynalin {

// Tokens in blocks, so that those which are stored stay where they are while others follow.
class TokenStore {
 public:
  std::span<const Token> add(std::span<const Token> tokens);
  // Gives back what was added before these, block by block.
  void release_before(std::span<const Token> stored);

 private:
  std::vector<std::pmr::vector<Token>> blocks_;
  std::size_t released_ = 0;  // so many blocks
};

// In as little memory as large datasets need, which have millions.
struct Statement {
  Span at{};                         // keyword and id together, the place to point at for the whole
  std::string_view name{};           // full upper-case name out of the keyword table, "" if unknown
  std::optional<std::int32_t> id{};  // after the slash
  WrittenArguments arguments{};
  std::uint32_t view_name_offset = 0, view_name_length = 0;  // in the source of `at`
  std::uint32_t keyword_length = 0;
  bool damaged = false;   // an error in it is already reported: id or arguments may be missing
  bool inactive = false;  // taken out of the model by a command; its id still exists

  Span keyword() const { return {at.source, at.offset, keyword_length}; }  // as written
  // Of a preceding `! adams_view_name='…'` comment, "" without one.
  std::string_view view_name() const { return Span{at.source, view_name_offset, view_name_length}.text(); }
};

// Can be moved and not copied, because the values of the arguments are spans into `tokens`. A single
// statement may be copied as long as its dataset lives.
struct Dataset {
  std::unique_ptr<BlockMemory> memory = std::make_unique<BlockMemory>();  // of the arguments of statements as read
  SourceRef source;
  std::string title;                                    // at most 80 bytes
  TokenStore tokens;                                    // of the values of all arguments
  std::deque<Statement> statements;                     // without END; unknown ones are kept, their name is ""
  std::vector<std::shared_ptr<const Dataset>> origins;  // whose tokens and texts edited statements point into

  // Give the memory of arguments back when the model is made of them; ids and places stay. Of one statement: those of
  // all before it must not be needed any more either.
  void release_arguments();
  void release_arguments(Statement&);

  Dataset() = default;
  Dataset(Dataset&&) = default;
  Dataset(const Dataset&) = delete;
  Dataset& operator=(const Dataset&) = delete;
  Dataset& operator=(Dataset&&) = delete;  // the old memory would go before what is in it
  ~Dataset() = default;
};

// Reads a whole dataset: title line, statements, END. Reports every problem it finds.
Parsed<Dataset> parse_dataset(SourceRef source);

// Reads lines of commands: same grammar, no title, no END, the slash may be left out, keywords out of
// `keywords` (they must outlive the result). Reading starts at byte `start`, behind the lines that name
// the model.
Parsed<Dataset> parse_statements(SourceRef source, std::span<const std::string_view> keywords, std::uint32_t start = 0);

// --- reading the value of one argument ------------------------------------------------------------
// Each reports what it found and what it expected at the right place and returns nothing on error.
// Between the numbers of a list a continuation comma counts as a comma, and merges with a comma before it.

std::optional<double> read_real(const WrittenArgument&, const SourceText&, Diagnostics&);
// `count` = 0 accepts any number of values ≥ 1.
std::optional<std::vector<double>> read_reals(const WrittenArgument&, const SourceText&, Diagnostics&,
                                              std::size_t count = 0);
// A whole number with the place where it stands.
struct WrittenInteger {
  std::int64_t value;
  Span at;
};
std::optional<WrittenInteger> read_integer(const WrittenArgument&, const SourceText&, Diagnostics&);
std::optional<std::vector<WrittenInteger>> read_integers(const WrittenArgument&, const SourceText&, Diagnostics&);
// One word, as written.
std::optional<Span> read_word(const WrittenArgument&, const SourceText&, Diagnostics&);
// Words separated by colons.
std::optional<std::vector<Span>> read_words(const WrittenArgument&, const SourceText&, Diagnostics&);
// Raw text such as a file name: from the first byte after '=' to the comma that ends it, without quotes
// around it.
std::optional<std::string> read_text(const WrittenArgument&, const SourceText&, Diagnostics&);

// --- words of the language -------------------------------------------------------------------------
// Readers look them up; which there are is for the catalogues to say, in folders above this one, and so the definitions
// stand there: every statement in elements/statement_names.cpp, every command in command/command_catalogue.cpp.in.
std::span<const std::string_view> statement_names();
std::span<const std::string_view> command_names();

// --- abbreviations ---------------------------------------------------------------------------------
// The one keyword lookup, used for statements, arguments, option words and commands alike: an exact
// match, else a unique prefix, else the candidate that the table of documented short forms prefers (M is
// MARKER among statements and MASS among the arguments of PART). Case is not significant. Returns the index,
// nothing if unknown (`ambiguous` lists the candidates of a tie).
std::optional<std::size_t> find_keyword(std::string_view word, std::span<const std::string_view> candidates,
                                        std::vector<std::string_view>* ambiguous = nullptr);

// Full name of a statement keyword by the priority table of the dataset language, "" if unknown.
std::string_view statement_name(std::string_view word);

// The candidate nearest to a misspelt word, "" if none is near: for hints.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace dynalin

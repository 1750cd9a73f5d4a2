#include "nastran_reader/deck_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

#include "base/read_file.h"

namespace dynalin::nastran_reader {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t deepest = 10;
constexpr std::size_t widest_include = 72;
// Files that include others over and over grow without being a cycle.
constexpr std::size_t most_includes = 20000;

bool begins_with_word(std::string_view line, std::string_view word) {
  line = trimmed(line);
  if (line.size() < word.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (std::toupper(static_cast<unsigned char>(line[i])) != word[i]) return false;
  }
  return line.size() == word.size() || !std::isalnum(static_cast<unsigned char>(line[word.size()]));
}

// What is left of a `$`, which begins a comment wherever no quote is open.
std::string_view without_comment(std::string_view line) {
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '$') {
      return line.substr(0, i);
    } else if ((c == '\'' || c == '"') && line.find(c, i + 1) != std::string_view::npos) {
      quote = c;
    }
  }
  return line;
}

std::string_view right_trimmed(std::string_view s) {
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.back()))) s.remove_suffix(1);
  return s;
}

class Loader {
 public:
  Loader(DeckLines& out, Diagnostics& diagnostics) : out_(out), diagnostics_(diagnostics) {}

  void load(SourceRef source, const fs::path& folder, const fs::path& canonical) {
    out_.sources.push_back(source);
    if (chain_.empty()) deck_folder_ = folder;
    chain_.push_back(canonical);
    const SourceText& text = *source;
    for (std::size_t n = 1; n <= text.line_count() && !out_.ended; ++n) {
      Line line;
      line.source = &text;
      const std::string_view whole = text.line(n);
      line.offset = static_cast<std::uint32_t>(whole.data() - text.text().data());
      line.text = right_trimmed(without_comment(whole));
      if (line.text.empty()) continue;
      if (begins_with_word(line.text, "INCLUDE")) {
        include(text, n, folder);
        continue;
      }
      if (begins_with_word(line.text, "ENDDATA")) {
        out_.ended = true;
        break;
      }
      out_.lines.push_back(line);
    }
    chain_.pop_back();
  }

 private:
  // Of the INCLUDE on line n; a name in quotes may end on a later line, and n is then that one.
  void include(const SourceText& text, std::size_t& n, const fs::path& folder) {
    std::string_view line = text.line(n);
    const auto offset_of = [&](std::string_view part) {
      return static_cast<std::uint32_t>(part.data() - text.text().data());
    };
    const auto first = static_cast<std::size_t>(
        std::find_if(line.begin(), line.end(), [](unsigned char c) { return !std::isspace(c); }) - line.begin());
    std::string_view rest = line.substr(first + std::string_view("INCLUDE").size());
    const std::size_t quote_at = rest.find_first_of("'\"");
    std::string name;
    Span at{&text, offset_of(line) + static_cast<std::uint32_t>(first), 7};
    const std::string_view before_quote = trimmed(rest.substr(0, std::min(quote_at, rest.size())));
    if (quote_at == std::string_view::npos || !(before_quote.empty() || before_quote == "=")) {
      check_width(right_trimmed(without_comment(line)), text);
      const std::string_view bare = trimmed(without_comment(rest));
      name = std::string(bare);
      if (!bare.empty()) at = {&text, offset_of(bare), static_cast<std::uint32_t>(bare.size())};
    } else {
      const char quote = rest[quote_at];
      std::string_view part = rest.substr(quote_at + 1);
      at = {&text, offset_of(part), static_cast<std::uint32_t>(right_trimmed(part).size())};
      for (;;) {
        const std::size_t end = part.find(quote);
        if (end != std::string_view::npos) {
          check_width(line.substr(0, static_cast<std::size_t>(part.data() - line.data()) + end + 1), text);
          name += part.substr(0, end);
          if (name.size() == end) at.length = static_cast<std::uint32_t>(end);
          break;
        }
        check_width(right_trimmed(line), text);
        name += right_trimmed(part);
        if (n == text.line_count()) {
          diagnostics_.error("include-missing", at, "the name after INCLUDE has no closing quote");
          return;
        }
        line = text.line(++n);
        part = trimmed(line);
      }
    }
    if (name.empty()) {
      diagnostics_.error("include-missing", at, "INCLUDE names no file", "INCLUDE 'name'");
      return;
    }
    open(name, at, folder);
  }

  void check_width(std::string_view line, const SourceText& text) {
    if (line.size() <= widest_include) return;
    const auto begin =
        static_cast<std::uint32_t>(static_cast<std::size_t>(line.data() - text.text().data()) + widest_include);
    diagnostics_.error(
        "include-long-line", {&text, begin, static_cast<std::uint32_t>(line.size() - widest_include)},
        fmt::format("the line of an INCLUDE has {} columns and may have {}", line.size(), widest_include),
        "break the name behind a / and go on in the next line");
  }

  void open(const std::string& name, const Span& at, const fs::path& folder) {
    if (chain_.size() > deepest) {
      diagnostics_.error("include-depth", at, fmt::format("INCLUDE is nested more than {} deep", deepest));
      return;
    }
    if (++includes_ > most_includes) {
      if (includes_ == most_includes + 1)
        diagnostics_.error("include-depth", at,
                           fmt::format("the deck includes files more than {} times", most_includes));
      return;
    }
    const fs::path written(name);
    std::error_code ignored;
    fs::path path = written.is_absolute() ? written : folder / written;
    if (!written.is_absolute() && !fs::exists(path, ignored) && fs::exists(deck_folder_ / written, ignored))
      path = deck_folder_ / written;
    const fs::path canonical = fs::weakly_canonical(path, ignored);
    if (std::find(chain_.begin(), chain_.end(), canonical) != chain_.end()) {
      diagnostics_.error("include-cycle", at, fmt::format("{} includes itself", name));
      return;
    }
    auto bytes = read_file(path.string());
    if (!bytes) {
      diagnostics_.error("include-missing", at, fmt::format("{} cannot be read: {}", name, bytes.error()));
      return;
    }
    load(std::make_shared<SourceText>(path.string(), std::move(*bytes)), path.parent_path(), canonical);
  }

  DeckLines& out_;
  Diagnostics& diagnostics_;
  std::vector<fs::path> chain_;
  fs::path deck_folder_;
  std::size_t includes_ = 0;
};

}  // namespace

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.front()))) s.remove_prefix(1);
  return right_trimmed(s);
}

std::string upper_trimmed(std::string_view s) {
  std::string out(trimmed(s));
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

DeckLines read_deck_lines(const std::string& path, Diagnostics& diagnostics) {
  DeckLines out;
  auto bytes = read_file(path);
  if (!bytes) {
    diagnostics.error("include-missing", {}, fmt::format("{} cannot be read: {}", path, bytes.error()));
    return out;
  }
  std::error_code ignored;
  Loader(out, diagnostics)
      .load(std::make_shared<SourceText>(path, std::move(*bytes)), fs::path(path).parent_path(),
            fs::weakly_canonical(path, ignored));
  return out;
}

DeckLines deck_lines_of_text(std::string name, std::string text, Diagnostics& diagnostics) {
  DeckLines out;
  Loader(out, diagnostics).load(std::make_shared<SourceText>(std::move(name), std::move(text)), {}, {});
  return out;
}

}  // namespace dynalin::nastran_reader

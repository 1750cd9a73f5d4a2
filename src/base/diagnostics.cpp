#include "base/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <map>
#include <utility>

namespace dynalin {

namespace {

// What follows the line end after the opening quote.
constexpr std::string_view behind_line_end(std::string_view text) { return text.substr(1); }

constexpr auto table = std::to_array<Explanation>({
#define DYNALIN_DIAGNOSTIC(code, text, advice) Explanation{code, text, behind_line_end(advice)},
#include "base/diagnostics.def"
#undef DYNALIN_DIAGNOSTIC
});

// The code out of the table, so that it outlives whatever the caller passed.
std::string_view listed(std::string_view code) {
  const Explanation* found = find_explanation(code);
  assert(found && "this code is missing in base/diagnostics.def");
  return found ? found->code : "unlisted";
}

std::string_view severity_name(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

// Length of the valid UTF-8 character at the start of text, 0 if there is none.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  }
  return length;
}

// What a terminal shows for one source character, each one column wide; tabs stay tabs.
struct Glyph {
  std::string_view text;
  std::size_t offset;  // byte in the line
};

std::vector<Glyph> glyphs(std::string_view line, std::size_t begin, std::size_t end) {
  std::vector<Glyph> result;
  for (std::size_t i = begin; i < end;) {
    const std::size_t length = character_length(line.substr(i));
    const auto byte = static_cast<unsigned char>(line[i]);
    const bool control = (byte < 0x20 && line[i] != '\t') || byte == 0x7F;
    result.push_back({length == 0 || control ? "?" : line.substr(i, length), i});
    i += std::max<std::size_t>(length, 1);
  }
  return result;
}

constexpr std::size_t widest_excerpt = 100;  // characters of a line that are shown
constexpr std::size_t lead_in = 60;          // of which so many may stand before the caret

// The numbered line and the caret line. Lines longer than the window are cut around the caret.
void append_excerpt(std::string& out, const Span& at, const SourceText::Place& place) {
  const std::string_view line = at.source->line(place.line);
  const std::size_t start = std::min(place.column - 1, line.size());
  // Bytes are looked at only near the caret: a line may be megabytes long. A character has up to 4.
  std::size_t from = start > 4 * widest_excerpt ? start - 4 * widest_excerpt : 0;
  while (from < start && (static_cast<unsigned char>(line[from]) & 0xC0) == 0x80) ++from;
  const std::size_t to = std::min(line.size(), start + 4 * widest_excerpt);
  std::vector<Glyph> shown = glyphs(line, from, to);

  const auto at_caret = std::find_if(shown.begin(), shown.end(), [&](const Glyph& g) { return g.offset >= start; });
  std::size_t caret = static_cast<std::size_t>(at_caret - shown.begin());
  const bool whole_line_fits = from == 0 && to == line.size() && shown.size() <= widest_excerpt;
  bool cut_left = false, cut_right = false;
  if (!whole_line_fits) {
    const std::size_t drop = caret > lead_in ? caret - lead_in : 0;
    cut_left = from > 0 || drop > 0;
    shown.erase(shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(drop));
    caret -= drop;
    cut_right = to < line.size() || shown.size() > widest_excerpt;
    if (shown.size() > widest_excerpt) shown.resize(widest_excerpt);
  }

  const std::size_t end = start + at.length;
  std::string text, marks;
  if (cut_left) text += "...", marks += "   ";
  for (std::size_t i = 0; i < shown.size(); ++i) {
    text += shown[i].text;
    if (i < caret) {
      marks += shown[i].text == "\t" ? '\t' : ' ';
    } else if (i > caret && shown[i].offset < end) {
      marks += '~';
    } else if (i == caret) {
      marks += '^';
    }
  }
  if (caret >= shown.size()) marks += '^';
  if (cut_right) text += "...";
  const std::string number = fmt::format("{:>5}", place.line);
  out += fmt::format("{} | {}\n{} | {}\n", number, text, std::string(number.size(), ' '), marks);
}

void append_place_and_text(std::string& out, const Span& at, std::string_view severity, std::string_view message,
                           std::string_view code) {
  const std::string ending = code.empty() ? "" : fmt::format(" [{}]", code);
  if (!at.source) {
    out += fmt::format("{}: {}{}\n", severity, message, ending);
    return;
  }
  const SourceText::Place place = at.source->place(at.offset);
  out += fmt::format("{}:{}:{}: {}: {}{}\n", at.source->name(), place.line, place.column, severity, message, ending);
  append_excerpt(out, at, place);
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} more {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace

Diagnostic& Diagnostics::error(std::string_view code, const Span& at, std::string message, std::string hint) {
  ++error_count_;
  return items_.emplace_back(Diagnostic{Severity::error, listed(code), at, std::move(message), std::move(hint), {}});
}

Diagnostic& Diagnostics::warning(std::string_view code, const Span& at, std::string message, std::string hint) {
  return items_.emplace_back(Diagnostic{Severity::warning, listed(code), at, std::move(message), std::move(hint), {}});
}

void Diagnostics::append(Diagnostics other) {
  items_.insert(items_.end(), std::make_move_iterator(other.items_.begin()),
                std::make_move_iterator(other.items_.end()));
  error_count_ += other.error_count_;
}

std::string render(const Diagnostic& diagnostic) {
  std::string out;
  append_place_and_text(out, diagnostic.at, severity_name(diagnostic.severity), diagnostic.message, diagnostic.code);
  if (!diagnostic.hint.empty()) out += fmt::format("hint: {}\n", diagnostic.hint);
  for (const Note& note : diagnostic.notes) {
    append_place_and_text(out, note.at, "note", note.message, "");
  }
  return out;
}

std::string render(const Diagnostics& diagnostics, std::size_t limit) {
  // Sources keep the order in which they first appear, so that no output depends on addresses.
  std::map<const SourceText*, std::size_t> rank;
  std::vector<const Diagnostic*> ordered;
  for (const Diagnostic& item : diagnostics.items()) {
    rank.try_emplace(item.at.source, rank.size());
    ordered.push_back(&item);
  }
  std::stable_sort(ordered.begin(), ordered.end(), [&](const Diagnostic* a, const Diagnostic* b) {
    return std::pair(rank.at(a->at.source), a->at.offset) < std::pair(rank.at(b->at.source), b->at.offset);
  });

  // Each kind is counted for itself, so that one slip repeated a thousand times hides no other.
  std::string out;
  std::map<std::pair<Severity, std::string_view>, std::size_t> seen;
  for (const Diagnostic* item : ordered) {
    if (++seen[{item->severity, item->code}] <= limit) out += render(*item);
  }
  for (const auto& [kind, count] : seen) {
    if (count <= limit) continue;
    out += fmt::format("{} of the kind [{}]\n", counted(count - limit, severity_name(kind.first)), kind.second);
  }
  return out;
}

std::span<const Explanation> explanations() { return table; }

const Explanation* find_explanation(std::string_view code) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Explanation& e) { return e.code == code; });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace dynalin

// The lines of a deck with its INCLUDE files in their places.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"

namespace dynalin::nastran_reader {

// Without its comment, line end and trailing blanks; never empty.
struct Line {
  const SourceText* source = nullptr;
  std::uint32_t offset = 0;  // of its first column
  std::string_view text;

  Span span() const { return {source, offset, static_cast<std::uint32_t>(text.size())}; }
  Span span(std::size_t begin, std::size_t length) const {
    return {source, offset + static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(length)};
  }
};

struct DeckLines {
  std::vector<SourceRef> sources;  // the deck itself first
  std::vector<Line> lines;         // up to ENDDATA
  bool ended = false;              // by ENDDATA
};

// Reads the file and what it includes. A name is looked up from the folder of the file that names it, then from that of
// the deck. The deck itself that cannot be read is an error without a place.
DeckLines read_deck_lines(const std::string& path, Diagnostics&);
// The same of a text in memory; includes are looked up from the working folder.
DeckLines deck_lines_of_text(std::string name, std::string text, Diagnostics&);

// Letters in upper case, without blanks around.
std::string upper_trimmed(std::string_view);
std::string_view trimmed(std::string_view);

}  // namespace dynalin::nastran_reader

// The text of one input file and places in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dynalin {

// Owns the bytes of one file and knows its lines, which end with LF, CR LF or CR. Constant once made. A UTF-8
// byte order mark is not part of the text. Columns count bytes. Throws std::length_error beyond 4 GiB.
class SourceText {
 public:
  SourceText(std::string name, std::string text);

  const std::string& name() const { return name_; }  // as the user wrote it, for messages
  std::string_view text() const { return text_; }
  std::size_t line_count() const { return line_starts_.size(); }
  // One-based line and column of a byte offset.
  struct Place {
    std::size_t line, column;
  };
  Place place(std::uint32_t offset) const;
  std::string_view line(std::size_t one_based) const;  // without its line end

 private:
  std::string name_;
  std::string text_;
  std::vector<std::uint32_t> line_starts_;
};

using SourceRef = std::shared_ptr<const SourceText>;

// A stretch of one source; source is null for things that no file states.
struct Span {
  const SourceText* source = nullptr;
  std::uint32_t offset = 0;
  std::uint32_t length = 0;

  std::string_view text() const { return source ? source->text().substr(offset, length) : ""; }
};

// From the start of a to the end of b (same source).
Span join(const Span& a, const Span& b);

// For messages: what is written there without the line ends, comments and commas by which it goes on, of more than
// `most` bytes the beginning.
std::string on_one_line(const Span&, std::size_t most = std::string::npos);

}  // namespace dynalin

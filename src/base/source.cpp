#include "base/source.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <stdexcept>
#include <utility>

namespace dynalin {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr char end_of_dos_text = '\x1A';  // Ctrl-Z, one or as many as filled a block of a disk

// Lines end with LF, CR LF or CR. A line end at the very end of the text starts no further line.
std::vector<std::uint32_t> starts_of_lines(std::string_view text) {
  std::vector<std::uint32_t> starts;
  starts.reserve(static_cast<std::size_t>(std::ranges::count(text, '\n')) + 1);
  starts.push_back(0);
  std::size_t line_feed = std::min(text.find('\n'), text.size());
  for (std::size_t begin = 0; begin < text.size();) {
    if (line_feed < begin) line_feed = std::min(text.find('\n', begin), text.size());
    const std::size_t end = std::min(text.substr(begin, line_feed - begin).find('\r'), line_feed - begin) + begin;
    begin = end + 1 == line_feed ? line_feed + 1 : end + 1;
    if (begin < text.size()) starts.push_back(static_cast<std::uint32_t>(begin));
  }
  return starts;
}

}  // namespace

SourceText::SourceText(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {
  if (text_.starts_with(byte_order_mark)) text_.erase(0, byte_order_mark.size());
  text_.erase(text_.find_last_not_of(end_of_dos_text) + 1);
  if (text_.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error(name_ + " is longer than 4 GiB");
  }
  line_starts_ = starts_of_lines(text_);
}

SourceText::Place SourceText::place(std::uint32_t offset) const {
  offset = std::min(offset, static_cast<std::uint32_t>(text_.size()));
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const auto index = static_cast<std::size_t>(after - line_starts_.begin()) - 1;
  // A place inside the line end counts as just behind the last character.
  const std::size_t column = std::min<std::size_t>(offset - line_starts_[index], line(index + 1).size());
  return {index + 1, column + 1};
}

std::string_view SourceText::line(std::size_t one_based) const {
  if (one_based == 0 || one_based > line_starts_.size()) return {};
  const std::size_t begin = line_starts_[one_based - 1];
  std::size_t end = one_based < line_starts_.size() ? line_starts_[one_based] : text_.size();
  if (end > begin && text_[end - 1] == '\n') --end;
  if (end > begin && text_[end - 1] == '\r') --end;
  return std::string_view(text_).substr(begin, end - begin);
}

Span join(const Span& a, const Span& b) {
  if (!a.source) return b;
  if (!b.source) return a;
  assert(a.source == b.source);
  const std::uint32_t begin = std::min(a.offset, b.offset);
  const std::uint32_t end = std::max(a.offset + a.length, b.offset + b.length);
  return {a.source, begin, end - begin};
}

std::string on_one_line(const Span& span, std::size_t most) {
  std::string line;
  const std::string_view text = span.text();
  bool is_comment = false, begins = false;
  for (const char c : text) {
    if (c == '\n' || c == '\r') {
      is_comment = false, begins = true;
    } else if (is_comment || (begins && (c == ' ' || c == '\t'))) {
      continue;
    } else if (begins && c == ',') {
      begins = false;
      while (!line.empty() && line.back() == ' ') line.pop_back();
      line += ' ';
    } else if (c == '!') {
      is_comment = true;
    } else if (const bool is_blank = c == ' ' || c == '\t'; !is_blank || (!line.empty() && line.back() != ' ')) {
      begins = false;
      line += is_blank ? ' ' : c;
    }
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  if (line.size() > most) line.resize(most), line += " …";
  return line;
}

}  // namespace dynalin

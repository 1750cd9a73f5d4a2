#include "elements/requests/lenient.h"

namespace dynalin {

namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string without_quotes(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
  const bool quoted = text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return std::string(quoted ? text.substr(1, text.size() - 2) : text);
}

}  // namespace

const WrittenArgument* written_argument(const ElementReader& reader, std::string_view name) {
  for (const ElementReader::Assignment& a : reader.assignments) {
    if (a.name != name) continue;
    for (const WrittenArgument& w : reader.statement().arguments) {
      if (w.name.offset == a.at.offset && w.name.source == a.at.source) return &w;
    }
  }
  return nullptr;
}

std::vector<std::string> split_texts(std::string_view written, char separator) {
  if (separator == '\0') return {without_quotes(written)};
  std::vector<std::string> list;
  std::size_t begin = 0;
  char quote = 0;
  bool line_begins = false;
  for (std::size_t k = 0; k < written.size(); ++k) {
    const char c = written[k];
    if (quote) {
      if (c == quote) quote = 0;
      continue;
    }
    const bool nothing_yet = written.substr(begin, k - begin).find_first_not_of(blanks) == std::string_view::npos;
    if (c == separator) {
      // The mark of continuation behind a comma at the end of the line before.
      if (separator == ',' && line_begins && nothing_yet && !list.empty()) {
        begin = k + 1, line_begins = false;
        continue;
      }
      list.push_back(without_quotes(written.substr(begin, k - begin)));
      begin = k + 1;
    } else if ((c == '"' || c == '\'') && nothing_yet) {
      quote = c;
    }
    if (blanks.find(c) == std::string_view::npos) line_begins = false;
    if (c == '\n') line_begins = true;
  }
  list.push_back(without_quotes(written.substr(begin)));
  return list;
}

std::vector<std::string> split_names(std::string_view written) {
  auto list = split_texts(written, ',');
  return list.size() > 1 ? list : split_texts(written, ':');
}

}  // namespace dynalin

#include "reduction/freedom_list.h"

#include <fmt/format.h>

#include <set>

#include "reduction/text_scanner.h"

namespace dynalin::reduction {

namespace {

std::optional<Freedom> freedom_of(std::string_view word, TextScanner& scanner) {
  // `21.1` is a node and a direction, not a decimal number.
  const std::size_t point = word.find('.');
  const std::string_view direction = point == std::string_view::npos ? scanner.word() : word.substr(point + 1);
  const auto node = TextScanner::integer<NodeLabel>(word.substr(0, point));
  const auto number = TextScanner::integer<int>(direction);
  if (!node || !number || !scanner.word().empty()) return std::nullopt;
  return Freedom{*node, *number};
}

}  // namespace

std::optional<std::vector<Freedom>> read_freedoms(const SourceText& file, Diagnostics& diagnostics) {
  std::vector<Freedom> freedoms;
  std::set<Freedom> seen;
  TextScanner scanner(file);
  while (scanner.next_line()) {
    const std::string_view word = scanner.word();
    if (word.empty() || word.starts_with('#') || word.starts_with('%')) continue;
    const auto freedom = freedom_of(word, scanner);
    if (!freedom || freedom->direction < 0 || freedom->direction > 6) {
      diagnostics.error("fe-freedom", scanner.line_span(), "a line is the number of a node and its direction, 1 to 6",
                        "21.1, or 21 1: node 21 along x; 4 to 6 are rotations, 0 is a coordinate without a place");
      return std::nullopt;
    }
    if (!seen.insert(*freedom).second) {
      diagnostics.error("fe-freedom", scanner.line_span(),
                        fmt::format("node {}, direction {} is another row already", freedom->node, freedom->direction),
                        "beam and shell elements of CalculiX are expanded into solids whose nodes share one number: "
                        "solid elements are needed");
      return std::nullopt;
    }
    freedoms.push_back(*freedom);
  }
  if (freedoms.empty()) {
    diagnostics.error("fe-freedom", Span{&file, 0, 0}, fmt::format("{} has no freedoms", file.name()));
    return std::nullopt;
  }
  return freedoms;
}

}  // namespace dynalin::reduction

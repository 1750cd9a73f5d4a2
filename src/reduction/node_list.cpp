#include "reduction/node_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "dataset/characters.h"
#include "nastran_reader/deck.h"
#include "reduction/text_scanner.h"

namespace dynalin::reduction {

namespace {

enum class Kind { list, input_deck, nastran };

// By the first line that says anything.
Kind kind_of(const SourceText& file) {
  TextScanner scanner(file);
  while (scanner.next_line()) {
    const std::string word = upper_case(scanner.word());
    if (word.empty() || word.starts_with("**") || word.starts_with('#') || word.starts_with('%')) continue;
    if (word.starts_with('*')) return Kind::input_deck;
    const bool is_number = std::isdigit(static_cast<unsigned char>(word[0])) != 0 || word[0] == '+' || word[0] == '-';
    return is_number ? Kind::list : Kind::nastran;
  }
  return Kind::list;
}

class Reader {
 public:
  Reader(const SourceText& file, Diagnostics& diagnostics) : scanner_(file), diagnostics_(diagnostics) {}

  void read_list() {
    while (scanner_.next_line()) {
      const std::string_view word = scanner_.word();
      if (word.empty() || word.starts_with('#') || word.starts_with('%')) continue;
      if (!read_node(word, Missing::refused)) return;
    }
  }

  // Keyword lines begin with one *, comments with two.
  void read_input_deck() {
    std::optional<Data> data = Data::others;
    while (data && scanner_.next_line()) {
      const std::string_view word = scanner_.word();
      if (word.empty() || word.starts_with("**")) continue;
      if (word.starts_with('*')) {
        data = read_keyword();
      } else if (data == Data::nodes) {
        if (!read_node(word, Missing::zero)) return;
      } else if (data == Data::system && moves(word)) {
        system_ = scanner_.line_span();
      } else if (data == Data::instance && moves(word)) {
        diagnostics_.error("fe-node", scanner_.line_span(), "an instance that is moved or turned is not read",
                           "give the places of the nodes where the matrices have them, as lines of node, x, y, z");
        return;
      }
    }
  }
  NodeList take() { return std::move(list_); }

 private:
  // What the lines behind a keyword are.
  enum class Data { nodes, system, instance, others };
  // None after an error.
  std::optional<Data> read_keyword() {
    const Span at = scanner_.line_span();
    const std::string line = keyword_line();
    const std::string_view keyword = std::string_view(line).substr(0, line.find(','));
    if (keyword == "*RIGIDBODY") {
      const auto reference = number(line, ",REFNODE="), rotation = number(line, ",ROTNODE=");
      if (reference && rotation) list_.rotation_nodes.push_back({*reference, *rotation});
    }
    // *SYSTEM without lines goes back to global axes.
    if (keyword == "*SYSTEM" || keyword == "*ENDPART" || keyword == "*ENDINSTANCE") system_.reset();
    if (keyword == "*SYSTEM") return Data::system;
    if (keyword == "*INSTANCE") return Data::instance;
    if (keyword != "*NODE") return Data::others;
    const bool is_curved = parameter(line, ",SYSTEM=").value_or("R") != "R";
    if (!is_curved && !system_) return Data::nodes;
    diagnostics_.error("fe-node", system_.value_or(at), "nodes in another system are not read",
                       "give the places of the nodes along global axes");
    return std::nullopt;
  }
  // In capitals and without blanks; it goes on in the next line behind a comma at its end.
  std::string keyword_line() {
    std::string line;
    do {
      std::string part = upper_case(scanner_.line());
      std::erase_if(part, [](char c) { return c == ' ' || c == '\t'; });
      if (!part.starts_with("**")) line += part;
    } while (line.ends_with(',') && parameters_follow() && scanner_.next_line());
    return line;
  }
  // Or a comment, behind which they may.
  bool parameters_follow() const {
    TextScanner ahead = scanner_;
    if (!ahead.next_line()) return false;
    const std::string_view word = ahead.word();
    return word.starts_with("**") || (!word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0);
  }
  // Whether a line has anything but zeros.
  bool moves(std::string_view word) {
    for (; !word.empty(); word = scanner_.word()) {
      const auto value = TextScanner::real(word);
      if (!value || *value != 0) return true;
    }
    return false;
  }
  static std::optional<std::string_view> parameter(std::string_view line, std::string_view name) {
    const std::size_t at = line.find(name);
    if (at == std::string_view::npos) return std::nullopt;
    const std::string_view rest = line.substr(at + name.size());
    return rest.substr(0, rest.find(','));
  }
  static std::optional<NodeLabel> number(std::string_view line, std::string_view name) {
    const auto value = parameter(line, name);
    return value ? TextScanner::integer<NodeLabel>(*value) : std::nullopt;
  }
  // Coordinates that are not written are zero in decks; a list has all three.
  enum class Missing { refused, zero };
  bool read_node(std::string_view first, Missing missing) {
    const auto label = TextScanner::integer<NodeLabel>(first);
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    bool good = label.has_value();
    for (Eigen::Index k = 0; k < 3 && good; ++k) {
      const std::string_view word = scanner_.word();
      if (word.empty() && missing == Missing::zero) break;
      const auto value = TextScanner::real(word);
      good = value.has_value();
      if (good) place[k] = *value;
    }
    if (!good || !scanner_.word().empty()) {
      diagnostics_.error("fe-node", scanner_.line_span(), "a node is its number and x, y, z", "17 0.4 0 -0.015");
      return false;
    }
    const auto [at, is_new] = list_.nodes.emplace(*label, place);
    if (!is_new && at->second != place) {
      diagnostics_.error("fe-node", scanner_.line_span(),
                         fmt::format("node {} is stated twice, at two places", *label));
      return false;
    }
    return true;
  }

  TextScanner scanner_;
  Diagnostics& diagnostics_;
  NodeList list_;
  std::optional<Span> system_;  // that of the nodes that follow, where it is not the global one
};

std::optional<NodeList> read_grids(const SourceText& file, Diagnostics& diagnostics) {
  Diagnostics found;
  const nastran_reader::Deck deck = nastran_reader::deck_of_text(file.name(), std::string(file.text()), found);
  // Places in the deck's own copy of the text are places in this one; included files have none.
  const SourceText* copy = deck.text.sources.empty() ? nullptr : deck.text.sources[0].get();
  const auto here = [&](const Span& at) {
    return at.source && at.source == copy ? Span{&file, at.offset, at.length} : Span{&file, 0, 0};
  };
  for (const Diagnostic& d : found.items()) {
    if (d.severity == Severity::error) diagnostics.error(d.code, here(d.at), d.message, d.hint);
  }
  if (diagnostics.has_errors()) return std::nullopt;
  if (const auto defaults = deck.unknown.find("GRDSET"); defaults != deck.unknown.end()) {
    diagnostics.error("fe-node", here(defaults->second.first),
                      "GRDSET, which may give GRIDs another system than the basic one, is not read",
                      "write its fields into the GRIDs, or give the places of the nodes as lines of node, x, y, z");
    return std::nullopt;
  }
  NodeList list;
  for (const nastran_reader::Grid& grid : deck.grids) {
    if (grid.position_system.id != 0 || grid.system.id != 0) {
      diagnostics.error("fe-node", here(grid.id.at),
                        fmt::format("GRID {} is stated in another system than the basic one", grid.id.id),
                        "give the places of the nodes along basic axes, as lines of node, x, y, z");
      return std::nullopt;
    }
    list.nodes.emplace(grid.id.id, grid.x);
  }
  return list;
}

}  // namespace

std::optional<NodeList> read_nodes(const SourceText& file, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  const Kind kind = kind_of(file);
  std::optional<NodeList> list;
  if (kind == Kind::nastran) {
    list = read_grids(file, diagnostics);
  } else {
    Reader reader(file, diagnostics);
    kind == Kind::list ? reader.read_list() : reader.read_input_deck();
    list = reader.take();
  }
  if (diagnostics.error_count() > before) return std::nullopt;
  if (list->nodes.empty()) {
    diagnostics.error("fe-node", Span{&file, 0, 0}, fmt::format("{} has no nodes", file.name()),
                      "lines of node, x, y, z; an input deck with *NODE; or a Nastran deck with GRID");
    return std::nullopt;
  }
  return list;
}

}  // namespace dynalin::reduction

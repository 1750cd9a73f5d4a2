#include "elements/controls/spline_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <locale>
#include <sstream>

#include "base/enumeration.h"
#include "dataset/characters.h"

namespace dynalin {

namespace {

// The lines from one heading to the next.
struct PointList {
  std::string block, part;  // FRONT of [FRONT], XY of (XY): in capitals, without blanks; empty before any heading
  Span heading;             // without source before any heading
  SplineTable points;
  Span first;    // line of points
  Span strange;  // the first line that is none

  std::string name() const {
    if (block.empty() && part.empty()) return "the lines before any block";
    const std::string in_block = block.empty() ? "" : "[" + block + "]";
    return part.empty() ? in_block : in_block + "(" + part + ")";
  }
};

std::string bare_text(std::string_view text) {
  std::string bare;
  for (const char c : text) {
    if (!is_blank(c)) bare += to_upper(c);
  }
  return bare;
}

// The numbers of a line; nothing if it holds anything else.
std::optional<std::vector<double>> numbers_of(std::string_view line) {
  std::string text(line);
  for (char& c : text) {
    if (c == ',' || c == ';' || c == '\t') c = ' ';
  }
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  std::vector<double> numbers;
  for (double v = 0; in >> v;) numbers.push_back(v);
  if (!in.eof() || numbers.empty()) return std::nullopt;
  return numbers;
}

bool stands_between(const std::string& bare, char open, char close) {
  return bare.size() > 1 && bare.front() == open && bare.back() == close;
}

void take_line(PointList& list, std::string_view line, const std::string& bare, const Span& at) {
  const bool is_z = bare[0] == 'Z';
  auto numbers = numbers_of(is_z ? line.substr(line.find_first_of("zZ") + 1) : line);
  const auto& rows = list.points.rows;
  const bool fits = numbers && (is_z || (numbers->size() > 1 && (rows.empty() || numbers->size() == rows[0].size())));
  if (!fits) {
    if (!list.strange.source) list.strange = at;
  } else if (is_z) {
    list.points.z = std::move(*numbers);
  } else {
    if (rows.empty()) list.first = at;
    list.points.rows.push_back(std::move(*numbers));
  }
}

std::vector<PointList> lists_of(const SourceText& file) {
  std::vector<PointList> lists(1);
  for (std::size_t n = 1; n <= file.line_count(); ++n) {
    const std::string_view line = file.line(n);
    const std::string bare = bare_text(line);
    if (bare.empty()) continue;
    const Span at{&file, static_cast<std::uint32_t>(line.data() - file.text().data()),
                  static_cast<std::uint32_t>(line.size())};
    const bool block = stands_between(bare, '[', ']');
    if (block || stands_between(bare, '(', ')')) {
      PointList next;
      next.block = block ? bare.substr(1, bare.size() - 2) : lists.back().block;
      if (!block) next.part = bare.substr(1, bare.size() - 2);
      next.heading = at;
      lists.push_back(std::move(next));
    } else if (std::string_view("!$#{(").find(bare[0]) == std::string_view::npos &&
               bare.find('=') == std::string::npos) {
      take_line(lists.back(), line, bare, at);
    }
  }
  return lists;
}

std::string names_of(const std::vector<const PointList*>& lists) {
  constexpr std::size_t most = 10;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(most, lists.size()); ++k) names.push_back(lists[k]->name());
  if (lists.size() > most) names.push_back(fmt::format("{} more", lists.size() - most));
  return enumeration(names, "and");
}

// Several lists are never joined to one curve: which of them is meant?
void report_several(const SourceText& file, std::string_view block, const std::vector<const PointList*>& lists,
                    ElementReader& reader) {
  const Span at = reader.at(block.empty() ? "FILE" : "BLOCK");
  for (std::size_t k = 1; k < lists.size(); ++k) {
    const PointList &one = *lists[k - 1], &other = *lists[k];
    if (one.block != other.block) continue;
    const bool twice = one.part == other.part && other.heading.source;
    reader.diagnostics()
        .error("spline-data", at,
               twice ? fmt::format("{} stands twice in {}", other.name(), file.name())
                     : fmt::format("{} holds points in {} and in {}, which are one block", file.name(), one.name(),
                                   other.name()),
               "each curve needs a block of its own, [NAME]")
        .notes = {{one.first, "points of the first"}, {other.first, "points of the second"}};
    return;
  }
  reader.error("spline-data", at, fmt::format("{} holds points in {}: BLOCK is needed", file.name(), names_of(lists)),
               "BLOCK= names the block that is meant");
}

}  // namespace

std::optional<SplineTable> read_spline_table(const SourceText& file, std::string_view block, ElementReader& reader) {
  std::vector<PointList> lists = lists_of(file);
  const std::string wanted = bare_text(block);
  std::vector<const PointList*> with_points, others;
  Span strange;
  for (const PointList& list : lists) {
    if (wanted.empty() || list.block == wanted) {
      if (!strange.source) strange = list.strange;
      if (!list.points.rows.empty()) with_points.push_back(&list);
    } else if (!list.points.rows.empty() && !list.block.empty()) {
      others.push_back(&list);
    }
  }
  if (with_points.size() > 1) {
    report_several(file, block, with_points, reader);
    return std::nullopt;
  }
  // Texts in a part without points are what the file says about itself.
  if (with_points.size() == 1) strange = with_points[0]->strange;
  if (strange.source) {
    reader.error("spline-data", strange, "a line of numbers is expected, x first, all lines with as many columns");
    return std::nullopt;
  }
  if (with_points.empty()) {
    reader.error("spline-data", reader.at(block.empty() ? "FILE" : "BLOCK"),
                 block.empty() ? fmt::format("{} holds no points", file.name())
                               : fmt::format("{} holds no points in the block [{}]", file.name(), block),
                 others.empty() ? "" : fmt::format("it holds points in {}", names_of(others)));
    return std::nullopt;
  }
  return with_points[0]->points;
}

}  // namespace dynalin

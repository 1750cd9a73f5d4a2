#include "library/stated_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dynalin::library {

namespace {

constexpr std::string_view line_ends = "\r\n";

// So many numbers a line.
template <class Number>
std::string list_of(const std::vector<Number>& values) {
  std::string text;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::string_view gap = k == 0 ? "" : k % 6 == 0 ? ",\n, " : ", ";
    if constexpr (std::is_same_v<Number, double>)
      text += fmt::format("{}{:.17g}", gap, values[k]);
    else
      text += fmt::format("{}{}", gap, values[k]);
  }
  return text;
}

std::string text_of(const StatedArgument& a) {
  struct {
    std::string operator()(std::monostate) const { return {}; }
    std::string operator()(const StatedArgument::Numbers& v) const { return "=" + list_of(v); }
    std::string operator()(const StatedArgument::Ids& v) const { return "=" + list_of(v); }
    std::string operator()(const std::string& v) const { return "=" + v; }
  } value;
  return a.name + std::visit(value, a.value);
}

std::string text_of(const StatedElement& s) {
  std::string text;
  if (!s.name.empty()) text += fmt::format("! adams_view_name='{}'\n", s.name);
  text += s.element.id == 0 ? s.element.statement : s.element.text();
  for (std::size_t k = 0; k < s.arguments.size(); ++k)
    text += (k > 0 || s.element.id != 0 ? "\n, " : "/") + text_of(s.arguments[k]);
  return text + '\n';
}

bool is_word(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return ('A' <= c && c <= 'Z') || ('a' <= c && c <= 'z') || ('0' <= c && c <= '9') || c == '_';
  });
}

// Nothing that is not a value of its own, whatever the grammar makes of it.
std::string fault_of(const StatedArgument& a) {
  if (!is_word(a.name)) return fmt::format("'{}' is no name of an argument", a.name);
  if (const auto* numbers = std::get_if<StatedArgument::Numbers>(&a.value)) {
    if (numbers->empty()) return a.name + " has no numbers";
    if (!std::all_of(numbers->begin(), numbers->end(), [](double v) { return std::isfinite(v); }))
      return a.name + " holds what is no finite number";
  }
  if (const auto* ids = std::get_if<StatedArgument::Ids>(&a.value); ids && ids->empty()) return a.name + " has no ids";
  if (const auto* text = std::get_if<std::string>(&a.value)) {
    if (text->empty() || text->find_first_of("\r\n!&") != std::string::npos)
      return fmt::format("the value of {} is empty, or holds a comment or more than one line", a.name);
  }
  return {};
}

std::string fault_of(const StatedElement& s) {
  if (!is_word(s.element.statement) || s.element.id < 0)
    return fmt::format("'{}' names no statement", s.element.text());
  if (s.name.find_first_of("\r\n'") != std::string::npos) return "a view name holds a quote or more than one line";
  for (const StatedArgument& a : s.arguments) {
    if (std::string fault = fault_of(a); !fault.empty()) return fault;
  }
  return {};
}

}  // namespace

Parsed<Dataset> dataset_of(const std::string& title, const std::vector<StatedElement>& elements) {
  Diagnostics faults;
  if (title.find_first_of(line_ends) != std::string::npos)
    faults.error("unexpected-text", {}, "the title has several lines");
  std::string text = title + '\n';
  for (const StatedElement& s : elements) {
    if (const std::string fault = fault_of(s); !fault.empty())
      faults.error("unexpected-text", {}, fmt::format("{}: {}", s.element.text(), fault));
    text += text_of(s);
  }
  if (faults.has_errors()) return {{}, std::move(faults)};
  Parsed<Dataset> parsed = parse_dataset(std::make_shared<const SourceText>("(built)", text + "END\n"));
  // A comma in a text begins an argument that nobody has given, and END ends everything.
  const auto& read = parsed.value.statements;
  if (read.size() != elements.size() && !parsed.diagnostics.has_errors())
    parsed.diagnostics.error("unexpected-text", {},
                             fmt::format("{} statements are read as {}", elements.size(), read.size()));
  for (std::size_t k = 0; k < std::min(read.size(), elements.size()); ++k) {
    const std::size_t given = elements[k].arguments.size();
    if (read[k].arguments.size() != given && !read[k].damaged)
      parsed.diagnostics.error("unexpected-text", read[k].at,
                               fmt::format("{} has {} argument{}, and is read with {}", elements[k].element.text(),
                                           given, given == 1 ? "" : "s", read[k].arguments.size()),
                               "a value is one number, one list or one expression");
  }
  return parsed;
}

}  // namespace dynalin::library

#include "nastran_reader/matrix_selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "nastran_reader/field.h"

namespace dynalin::nastran_reader {

void MatrixSelection::take(const Command& command, bool within_subcases) {
  if (command.values.empty()) {
    diagnostics_.error("case-command", command.at, fmt::format("{} names no matrix", command.name));
    return;
  }
  if (const auto before = values_.find(command.name); before != values_.end() && within_subcases) {
    const auto alike = [](const Piece& a, const Piece& b) { return upper_trimmed(a.text) == upper_trimmed(b.text); };
    if (!std::ranges::equal(before->second, command.values, alike))
      diagnostics_.error("case-command", command.at, fmt::format("{} changes between subcases", command.name),
                         "a direct solution keeps its constraints and matrices: write it above the subcases");
    return;
  }
  values_[command.name] = command.values;
}

std::map<std::string, std::vector<MatrixUse>> MatrixSelection::uses(const std::map<int, NamedSet>& sets) {
  std::map<std::string, std::vector<MatrixUse>> all;
  for (const auto& [name, values] : values_) {
    std::vector<MatrixUse>& uses = all[name];
    std::size_t factors = 0;
    for (const Piece& value : values) {
      const Field f = read_field(value.text, value.at);
      if (f.form == Field::Form::integer) {
        const auto found = sets.find(f.integer);
        if (found == sets.end() || found->second.names.empty()) {
          diagnostics_.error("undefined-card-id", value.at,
                             fmt::format("{} names SET {}, which is no list of matrices", name, f.integer));
          continue;
        }
        for (const auto& [text, at] : found->second.names) {
          if (auto u = use(text, at)) uses.push_back(std::move(*u));
        }
        continue;
      }
      if (auto u = use(value.text, value.at)) uses.push_back(std::move(*u));
      if (value.text.find('*') != std::string_view::npos) ++factors;
    }
    if (factors > 0 && factors < values.size())
      diagnostics_.error("case-command", values[0].at,
                         fmt::format("some matrices of {} have a factor and some have none", name),
                         "write 1.0* before those that have none");
  }
  return all;
}

// NAME, 2.0*NAME, (1.0,0.0)*NAME
std::optional<MatrixUse> MatrixSelection::use(std::string_view text, const Span& at) {
  MatrixUse u;
  u.at = at;
  std::string_view name = text;
  if (const std::size_t star = text.find('*'); star != std::string_view::npos) {
    const auto by = factor(trimmed(text.substr(0, star)), at);
    if (!by) return std::nullopt;
    u.factor = *by;
    name = text.substr(star + 1);
  }
  const Field f = read_field(name, at);
  if (f.form != Field::Form::word) {
    diagnostics_.error("case-command", at, fmt::format("{} is no name of a matrix", name));
    return std::nullopt;
  }
  u.name = f.text;
  return u;
}

std::optional<double> MatrixSelection::factor(std::string_view text, const Span& at) {
  if (!text.starts_with('(') || !text.ends_with(')')) {
    const Field f = read_field(text, at);
    if (f.form == Field::Form::real || f.form == Field::Form::integer) return f.real;
    diagnostics_.error("case-command", at, fmt::format("{} is no factor of a matrix", text), "2.0*NAME");
    return std::nullopt;
  }
  const auto parts = split(text.substr(1, text.size() - 2));
  const Field re = read_field(parts[0], at), im = read_field(parts.size() > 1 ? parts[1] : "", at);
  if (parts.size() != 2 || re.form != Field::Form::real || im.form != Field::Form::real) {
    diagnostics_.error("case-command", at, fmt::format("{} is no complex factor", text), "(1.0,0.0)*NAME");
    return std::nullopt;
  }
  if (im.real != 0) {
    diagnostics_.error("unassembled-card", at, "complex matrices are not solved here");
    return std::nullopt;
  }
  return re.real;
}

}  // namespace dynalin::nastran_reader

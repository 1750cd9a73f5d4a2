#include "elements/bodies/fe_part_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "dataset/tokens.h"

namespace dynalin {

namespace {

struct RowField {
  std::string_view name;  // of the list that states the same
  std::vector<double> FePart::*list;
};
constexpr std::array<RowField, 6> place_fields = {{{"X", &FePart::x},
                                                   {"Y", &FePart::y},
                                                   {"Z", &FePart::z},
                                                   {"PSI", &FePart::psi},
                                                   {"THETA", &FePart::theta},
                                                   {"PHI", &FePart::phi}}};
constexpr std::array<RowField, 5> section_fields = {{{"AREA", &FePart::area},
                                                     {"IYY", &FePart::yy},
                                                     {"IZZ", &FePart::zz},
                                                     {"IYZ", &FePart::yz},
                                                     {"IXX", &FePart::torsion}}};

struct NodeRows {
  std::string_view name;
  std::vector<double> FePart::*numbers;
  std::string_view of_a_node;  // for messages
  std::span<const RowField> fields;

  std::size_t width() const { return 1 + fields.size(); }
};
constexpr std::array<NodeRows, 2> forms = {
    {{"COORDINATES", &FePart::coordinates, "label, x, y, z, psi, theta, phi", place_fields},
     {"SECTION", &FePart::sections, "label, area, Iyy, Izz, Iyz, J", section_fields}}};

// Of the k-th number that is written.
Span number_at(const NodeRows& rows, std::size_t k, const ElementReader& reader) {
  const Span name = reader.at(rows.name);
  for (const WrittenArgument& w : reader.statement().arguments) {
    if (w.name.source != name.source || w.name.offset != name.offset) continue;
    for (const Token& token : w.value()) {
      if (token.kind == TokenKind::number && k-- == 0) return token_span(token, *name.source);
    }
  }
  return name;
}

// By row; nothing after an error.
std::optional<std::vector<std::int64_t>> row_labels(const NodeRows& rows, const FePart& f, ElementReader& reader) {
  constexpr double largest_label = 9007199254740992.0;  // 2^53: beyond it neighbours coincide
  const std::vector<double>& numbers = f.*rows.numbers;
  const std::string owner = fmt::format("{} of {}", rows.name, reader.label().text());
  const std::string hint = fmt::format("each node has {} numbers: {}", rows.width(), rows.of_a_node);
  if (numbers.size() % rows.width() != 0) {
    reader.error("wrong-count", reader.at(rows.name),
                 fmt::format("{} has {} numbers, which are no rows of {}", owner, numbers.size(), rows.width()), hint);
    return std::nullopt;
  }
  std::vector<std::int64_t> labels;
  for (std::size_t k = 0; k < numbers.size(); k += rows.width()) {
    const double label = numbers[k];
    if (!(label > 0) || label > largest_label || label != std::floor(label)) {
      reader.error("expected-integer", number_at(rows, k, reader),
                   fmt::format("{} has {} where the label of a node belongs", owner, label), hint);
      return std::nullopt;
    }
    labels.push_back(static_cast<std::int64_t>(label));
  }
  return labels;
}

// By label, each once; empty after an error.
using RowByLabel = std::unordered_map<std::int64_t, std::size_t>;
RowByLabel rows_by_label(const NodeRows& rows, std::span<const std::int64_t> labels, ElementReader& reader) {
  RowByLabel list;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (list.emplace(labels[k], k).second) continue;
    reader.error("value-out-of-range", number_at(rows, k * rows.width(), reader),
                 fmt::format("{} of {} states node {} twice", rows.name, reader.label().text(), labels[k]));
    return {};
  }
  return list;
}

bool is_one_form(const NodeRows& rows, ElementReader& reader) {
  for (const RowField& field : rows.fields) {
    if (!reader.given(field.name)) continue;
    reader.error("excluded-arguments", reader.at(field.name),
                 fmt::format("{} and {} of {} state the same", rows.name, field.name, reader.label().text()),
                 fmt::format("{} has {} of each node: leave {} out, or write lists alone", rows.name, rows.of_a_node,
                             field.name));
    return false;
  }
  return true;
}

bool take(const NodeRows& rows, FePart& f, ElementReader& reader) {
  if (!reader.given(rows.name)) return true;
  if (!is_one_form(rows, reader)) return false;
  const auto labels = row_labels(rows, f, reader);
  if (!labels) return false;
  const RowByLabel by_label = rows_by_label(rows, *labels, reader);
  if (by_label.empty()) return false;
  const std::string owner = fmt::format("{} of {}", rows.name, reader.label().text());
  const std::unordered_set<std::int64_t> nodes(f.numbers.begin(), f.numbers.end());
  for (std::size_t k = 0; k < labels->size(); ++k) {
    if (nodes.contains((*labels)[k])) continue;
    reader.error("unknown-node", number_at(rows, k * rows.width(), reader),
                 fmt::format("{} states node {}, which the beam does not have", owner, (*labels)[k]),
                 reader.given("NODE_LABELS") ? "NODE_LABELS lists its nodes" : "COORDINATES lists its nodes");
    return false;
  }
  for (const RowField& field : rows.fields) (f.*field.list).clear();
  for (const std::int64_t label : f.numbers) {
    const auto row = by_label.find(label);
    if (row == by_label.end()) {
      reader.error("wrong-count", reader.at(rows.name), fmt::format("{} does not state node {}", owner, label));
      return false;
    }
    for (std::size_t i = 0; i < rows.fields.size(); ++i)
      (f.*rows.fields[i].list).push_back((f.*rows.numbers)[row->second * rows.width() + 1 + i]);
  }
  return true;
}

}  // namespace

bool is_rows(std::string_view argument) {
  return std::ranges::any_of(forms, [&](const NodeRows& rows) { return rows.name == argument; });
}

bool labels_nodes(FePart& f, ElementReader& reader) {
  if (reader.given("NODE_LABELS")) return true;
  const NodeRows& places = forms.front();
  const auto labels = row_labels(places, f, reader);
  if (!labels || rows_by_label(places, *labels, reader).empty()) return false;
  f.numbers = *labels;
  return true;
}

bool take_rows(FePart& f, ElementReader& reader) {
  return std::ranges::all_of(forms, [&](const NodeRows& rows) { return take(rows, f, reader); });
}

Span stated_at(const FePart& f, std::string_view list, std::size_t node, const ElementReader& reader) {
  for (const NodeRows& rows : forms) {
    const auto field = std::ranges::find(rows.fields, list, &RowField::name);
    if (field == rows.fields.end() || !reader.given(rows.name)) continue;
    const std::vector<double>& numbers = f.*rows.numbers;
    for (std::size_t k = 0; k < numbers.size(); k += rows.width()) {
      if (numbers[k] == static_cast<double>(f.numbers[node]))
        return number_at(rows, k + 1 + static_cast<std::size_t>(field - rows.fields.begin()), reader);
    }
  }
  return reader.at(list);
}

}  // namespace dynalin

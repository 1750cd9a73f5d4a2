#include "elements/graphics/checks.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "geometry/revolution.h"

namespace dynalin::drawing {

namespace {

void out_of_range(ElementReader& reader, std::string_view name, double value, std::string_view wanted) {
  reader.error("value-out-of-range", reader.at(name),
               fmt::format("{} of {} is {}, it must {}", name, reader.label().text(), value, wanted));
}

}  // namespace

void demand_positive(ElementReader& reader, std::string_view name, double value) {
  if (reader.given(name) && !(value > 0)) out_of_range(reader, name, value, "be more than 0");
}

void demand_not_zero(ElementReader& reader, std::string_view name, double value) {
  if (reader.given(name) && value == 0) out_of_range(reader, name, value, "not be 0");
}

void demand_angle(ElementReader& reader, double angle) {
  demand_not_zero(reader, "RANGLE", angle);
  if (std::abs(angle) > 2 * std::numbers::pi * (1 + rounding_of_turn))
    out_of_range(reader, "RANGLE", angle, "be at most one turn, 360D or 2π");
}

std::vector<MarkerId> listed_markers(ElementReader& reader, std::string_view name) {
  std::vector<MarkerId> markers;
  const Span at = reader.at(name);
  for (const WrittenArgument& w : reader.statement().arguments) {
    if (!reader.given(name) || w.name.offset != at.offset || w.name.source != at.source) continue;
    Diagnostics known;  // what is wrong with the list itself was reported when it was read
    const auto ids = read_integers(w, *w.name.source, known);
    if (!ids) continue;
    for (const WrittenInteger& id : *ids) {
      if (const auto m = reader.marker(id, name)) markers.push_back(*m);
    }
  }
  return markers;
}

}  // namespace dynalin::drawing

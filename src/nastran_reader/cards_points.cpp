// GRID, SPOINT, EPOINT, CORD1R/C/S, CORD2R/C/S.
#include <fmt/format.h>

#include "nastran_reader/card_fields.h"

namespace dynalin::nastran_reader {

namespace {

void grid(CardFields& c, Deck& deck) {
  Grid g;
  g.id = c.id(0, 2, "the number of the grid");
  g.position_system = c.reference(0, 3, "CP");
  g.x = c.vector(0, 4, "X");
  // CD = -1 is a point of a fluid.
  g.system = c.reference(0, 7, "CD");
  g.fixed = c.components(c.field(0, 8), "PS");
  // With another field wrong it still is there: what refers to it is right.
  if (g.id.id > 0) deck.grids.push_back(std::move(g));
}

void scalar_points(CardFields& c, Deck& deck) {
  const std::vector<Reference> ids = c.list(0, "the number of the point");
  if (ids.empty() && c.good()) c.wrong("field-missing", c.card().at, "no point is named");
  if (c.card().rows() > 1) c.wrong("field-overflow", c.card().end, "the card has no continuation", "write another one");
  for (const Reference& id : ids) deck.scalars.push_back({id});
}

System::Kind system_kind_of(const std::string& name) {
  return name.back() == 'C'   ? System::Kind::cylindrical
         : name.back() == 'S' ? System::Kind::spherical
                              : System::Kind::rectangular;
}

void system_by_coordinates(CardFields& c, Deck& deck) {
  System s;
  s.kind = system_kind_of(c.name());
  s.id = c.id(0, 2, "the number of the system");
  s.reference = c.reference(0, 3, "RID");
  if (c.card().rows() < 2) {
    c.wrong("field-missing", c.card().at, "the continuation with the point C is missing");
    return;
  }
  s.a = c.vector(0, 4, "A");
  s.b = c.vector(0, 7, "B");
  s.c = c.vector(1, 2, "C");
  if (c.good()) deck.systems.push_back(std::move(s));
}

// Two systems may stand on one card.
void system_by_points(CardFields& c, Deck& deck) {
  for (const std::size_t first : {std::size_t{2}, std::size_t{6}}) {
    if (first == 6 && c.blank(0, 6)) {
      c.refuse_beside_blank(0, 6, 3, "the number of a system");
      break;
    }
    System s;
    s.kind = system_kind_of(c.name());
    s.id = c.id(0, first, "the number of the system");
    for (std::size_t k = 1; k <= 3; ++k) s.by_points.push_back(c.id(0, first + k, fmt::format("grid {}", k)));
    if (c.good()) deck.systems.push_back(std::move(s));
  }
}

constexpr CardKind point_card_kinds[] = {
    {"GRID", grid, "xxxxxxxx"},
    {"SPOINT", scalar_points, list_in_rows},
    {"EPOINT", scalar_points, list_in_rows},
    {"CORD2R", system_by_coordinates, "xxxxxxxx|xxx-----"},
    {"CORD2C", system_by_coordinates, "xxxxxxxx|xxx-----"},
    {"CORD2S", system_by_coordinates, "xxxxxxxx|xxx-----"},
    {"CORD1R", system_by_points, "xxxxxxxx"},
    {"CORD1C", system_by_points, "xxxxxxxx"},
    {"CORD1S", system_by_points, "xxxxxxxx"},
};

}  // namespace

std::span<const CardKind> point_cards() { return point_card_kinds; }

}  // namespace dynalin::nastran_reader

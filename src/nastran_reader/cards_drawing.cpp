// PLOTEL, and structural elements with their properties: CROD, CTRIA3, CQUAD4, PROD, PSHELL, MAT1.
#include <fmt/format.h>

#include <set>

#include "nastran_reader/card_fields.h"

namespace dynalin::nastran_reader {

namespace {

std::size_t corners(const std::string& name) { return name == "CTRIA3" ? 3 : name == "CQUAD4" ? 4 : 2; }

void element(CardFields& c, Deck& deck) {
  UndeformedElement e;
  e.card = c.name();
  e.id = c.id(0, 2, "the number of the element");
  const bool line = c.name() == "PLOTEL";
  if (!line) {
    e.property = c.reference(0, 3, "the property", 1);
    if (c.blank(0, 3)) e.property = {e.id.id, e.id.at};
  }
  for (std::size_t k = 0; k < corners(c.name()); ++k) {
    e.grids.push_back(c.id(0, k + (line ? 3 : 4), fmt::format("grid {}", k + 1)));
  }
  std::set<int> different;
  for (const Reference& g : e.grids) different.insert(g.id);
  if (c.good() && different.size() < e.grids.size()) c.wrong("field-range", e.grids[0].at, "a grid stands twice");
  if (c.good()) deck.undeformed.push_back(std::move(e));
}

void rod_property(CardFields& c, Deck& deck) {
  PlainProperty p;
  p.card = c.name();
  p.id = c.id(0, 2, "the number of the property");
  p.materials = {c.id(0, 3, "the material")};
  p.thickness = c.real(0, 4, "A");
  c.real(0, 5, "J");
  c.real(0, 6, "C");
  p.added_mass = c.real(0, 7, "NSM");
  if (c.good()) deck.plain_properties.push_back(std::move(p));
}

void shell_property(CardFields& c, Deck& deck) {
  PlainProperty p;
  p.card = c.name();
  p.id = c.id(0, 2, "the number of the property");
  for (const std::size_t at : {std::size_t{3}, std::size_t{5}, std::size_t{7}}) {
    if (c.blank(0, at)) continue;
    const Reference m = c.reference(0, at, "the material", -1);
    if (m.id > 0) p.materials.push_back(m);
  }
  p.thickness = c.real(0, 4, "T");
  c.real(0, 6, "12I/T**3");
  c.real(0, 8, "TS/T");
  p.added_mass = c.real(0, 9, "NSM");
  if (c.good()) deck.plain_properties.push_back(std::move(p));
}

void material(CardFields& c, Deck& deck) {
  Material m;
  m.id = c.id(0, 2, "the number of the material");
  c.real(0, 3, "E");
  c.real(0, 4, "G");
  c.real(0, 5, "NU");
  m.density = c.real(0, 6, "RHO");
  if (c.good()) deck.materials.push_back(std::move(m));
}

constexpr CardKind drawing_card_kinds[] = {
    {"PLOTEL", element, "xxx-----"},          {"CROD", element, "xxxx----"},
    {"CTRIA3", element, "xxxxxxx-|xxxxxxxx"}, {"CQUAD4", element, "xxxxxxxx|xxxxxxxx"},
    {"PROD", rod_property, "xxxxxx--"},       {"PSHELL", shell_property, "xxxxxxxx|xxx-----"},
    {"MAT1", material, "xxxxxxxx|xxxx----"},
};

}  // namespace

std::span<const CardKind> drawing_cards() { return drawing_card_kinds; }

}  // namespace dynalin::nastran_reader

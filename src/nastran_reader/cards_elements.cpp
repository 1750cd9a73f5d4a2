// Masses, springs, dampers and bushes: CONM1, CONM2, CELASi, CDAMPi, CMASSi with their properties, CBUSH, PBUSH.
#include <fmt/format.h>

#include "nastran_reader/card_fields.h"

namespace dynalin::nastran_reader {

namespace {

void conm2(CardFields& c, Deck& deck) {
  Mass m;
  m.id = c.id(0, 2, "the number of the element");
  m.grid = c.id(0, 3, "the grid");
  m.system = c.reference(0, 4, "CID", -1);
  m.mass = c.real(0, 5, "the mass");
  m.offset = c.vector(0, 6, "X");
  const double i11 = c.real(1, 2, "I11"), i21 = c.real(1, 3, "I21"), i22 = c.real(1, 4, "I22");
  const double i31 = c.real(1, 5, "I31"), i32 = c.real(1, 6, "I32"), i33 = c.real(1, 7, "I33");
  // The card has products of inertia, which stand in the tensor with the opposite sign.
  m.inertia << i11, -i21, -i31, -i21, i22, -i32, -i31, -i32, i33;
  if (c.good()) deck.masses.push_back(std::move(m));
}

void conm1(CardFields& c, Deck& deck) {
  Mass m;
  m.id = c.id(0, 2, "the number of the element");
  m.grid = c.id(0, 3, "the grid");
  m.system = c.reference(0, 4, "CID");
  Matrix6 all = Matrix6::Zero();
  std::size_t index = 3;
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j, ++index) {
      all(i, j) = all(j, i) = c.real(c.field(index / 8, index % 8 + 2), fmt::format("M{}{}", i + 1, j + 1));
    }
  }
  m.matrix = all;
  if (c.good()) deck.masses.push_back(std::move(m));
}

ScalarElement::Kind scalar_kind_of(const std::string& name) {
  return name.starts_with("CELAS")   ? ScalarElement::Kind::stiffness
         : name.starts_with("CDAMP") ? ScalarElement::Kind::damping
                                     : ScalarElement::Kind::mass;
}

// 1: property and components; 2: value and components; 3: property and scalar points; 4: value and scalar points.
void scalar_element(CardFields& c, Deck& deck) {
  ScalarElement e;
  e.card = c.name();
  e.kind = scalar_kind_of(c.name());
  e.id = c.id(0, 2, "the number of the element");
  const char form = c.name().back();
  const bool by_property = form == '1' || form == '3';
  if (by_property) {
    e.property = c.reference(0, 3, "the property", 1);
    if (c.blank(0, 3)) e.property = {e.id.id, e.id.at};
  } else {
    e.value = c.real(0, 3, "the value");
  }
  static const Field none;
  for (const std::size_t at : {std::size_t{4}, form <= '2' ? std::size_t{6} : std::size_t{5}}) {
    if (c.blank(0, at)) {
      if (form <= '2') c.refuse_beside_blank(0, at, 1, "a point");
      continue;
    }
    if (c.field(0, at).form == Field::Form::integer && c.field(0, at).integer == 0) continue;
    e.ends.push_back(form <= '2' ? c.freedom(c.field(0, at), c.field(0, at + 1)) : c.freedom(c.field(0, at), none));
  }
  if (c.name() == "CELAS2" && !c.blank(0, 8) && c.real(0, 8, "GE") != 0)
    c.diagnostics().error("unassembled-card", c.field(0, 8).at, "CELAS2: structural damping GE is not solved here");
  if (e.ends.empty() && c.good()) c.wrong("field-missing", c.card().at, "no point is named");
  if (c.good()) deck.scalar_elements.push_back(std::move(e));
}

// PELAS has two properties on a card, PDAMP and PMASS four.
void scalar_property(CardFields& c, Deck& deck) {
  const bool spring = c.name() == "PELAS";
  const std::size_t step = spring ? 4 : 2;
  for (std::size_t first = 2; first < 10; first += step) {
    if (c.blank(0, first)) {
      c.refuse_beside_blank(0, first, step - 1, "the number of a property");
      continue;
    }
    const Reference id = c.id(0, first, "the number of the property");
    const double value = c.real(0, first + 1, "the value");
    if (spring && !c.blank(0, first + 2) && c.real(0, first + 2, "GE") != 0)
      c.diagnostics().error("unassembled-card", c.field(0, first + 2).at,
                            "PELAS: structural damping GE is not solved here");
    if (!c.good()) return;
    if (!deck.scalar_properties[c.name()].emplace(id.id, value).second)
      c.wrong("duplicate-card-id", id.at, fmt::format("the number {} stands twice", id.id));
  }
}

void cbush(CardFields& c, Deck& deck) {
  Bush b;
  b.id = c.id(0, 2, "the number of the element");
  b.property = c.reference(0, 3, "the property", 1);
  if (c.blank(0, 3)) b.property = {b.id.id, b.id.at};
  b.a = c.id(0, 4, "GA");
  b.b = c.reference(0, 5, "GB");
  const Field& go = c.field(0, 6);
  if (go.form == Field::Form::integer) {
    b.direction_grid = c.reference(go, "GO", 1);
  } else if (!go.blank() || !c.blank(0, 7) || !c.blank(0, 8)) {
    b.direction = c.vector(0, 6, "X");
  }
  if (!c.blank(0, 9)) b.system = c.reference(0, 9, "CID");
  b.along = c.real(1, 2, "S", 0.5);
  if (!c.blank(1, 3)) {
    const Reference r = c.reference(1, 3, "OCID", -1);
    if (c.field(1, 3).integer >= 0) b.offset_system = r;
  }
  b.offset = c.vector(1, 4, "S");
  if (c.good()) deck.bushes.push_back(std::move(b));
}

void pbush(CardFields& c, Deck& deck) {
  BushProperty p;
  p.id = c.id(0, 2, "the number of the property");
  for (std::size_t row = 0; row < c.card().rows(); ++row) {
    if (row > 0 && !c.blank(row, 2)) {
      c.wrong("field-form", c.field(row, 2).at, "field 2 of a continuation is blank, and the letter stands in field 3");
      return;
    }
    if (c.blank(row, 3)) {
      c.refuse_beside_blank(row, 3, 6, "a letter");
      continue;
    }
    const std::string letter = c.word(row, 3, "the kind of values");
    const auto any = [&] {
      for (std::size_t k = 4; k <= 9; ++k) {
        if (c.field(row, k).form == Field::Form::real && c.field(row, k).real != 0) return true;
      }
      return false;
    };
    if (letter == "K" || letter == "B") {
      for (Eigen::Index k = 0; k < 6; ++k) {
        const Field& f = c.field(row, static_cast<std::size_t>(k) + 4);
        if (f.is_word("RIGID")) {
          c.diagnostics().error("unassembled-card", f.at, "PBUSH: RIGID is not solved here", "write an RBE2 or RBAR");
          continue;
        }
        (letter == "K" ? p.stiffness : p.damping)[k] = c.real(f, fmt::format("{}{}", letter, k + 1));
      }
    } else if (letter == "GE" || letter == "M") {
      if (any())
        c.diagnostics().error(
            "unassembled-card", c.field(row, 3).at,
            fmt::format("PBUSH: {} is not solved here", letter == "M" ? "the mass M" : "structural damping GE"));
    } else if (letter != "RCV" && letter != "T" && !letter.empty()) {
      c.wrong("field-form", c.field(row, 3).at, fmt::format("{} is none of K, B, GE, RCV, M and T", letter));
    }
  }
  if (c.good()) deck.bush_properties.push_back(std::move(p));
}

constexpr CardKind element_card_kinds[] = {
    {"CONM2", conm2, "xxxxxxx-|xxxxxx--"},  {"CONM1", conm1, "xxxxxxxx|xxxxxxxx|xxxxxxxx"},
    {"CELAS1", scalar_element, "xxxxxx--"}, {"CELAS2", scalar_element, "xxxxxxxx"},
    {"CELAS3", scalar_element, "xxxx----"}, {"CELAS4", scalar_element, "xxxx----"},
    {"CDAMP1", scalar_element, "xxxxxx--"}, {"CDAMP2", scalar_element, "xxxxxx--"},
    {"CDAMP3", scalar_element, "xxxx----"}, {"CDAMP4", scalar_element, "xxxx----"},
    {"CMASS1", scalar_element, "xxxxxx--"}, {"CMASS2", scalar_element, "xxxxxx--"},
    {"CMASS3", scalar_element, "xxxx----"}, {"CMASS4", scalar_element, "xxxx----"},
    {"PELAS", scalar_property, "xxxxxxxx"}, {"PDAMP", scalar_property, "xxxxxxxx"},
    {"PMASS", scalar_property, "xxxxxxxx"}, {"CBUSH", cbush, "xxxxxxxx|xxxxx---"},
    {"PBUSH", pbush, list_in_rows},
};

}  // namespace

std::span<const CardKind> element_cards() { return element_card_kinds; }

}  // namespace dynalin::nastran_reader

// MPC, MPCADD, RBE2, RJOINT, RBAR, SPC, SPC1, SPCADD.
#include <fmt/format.h>

#include "nastran_reader/card_fields.h"

namespace dynalin::nastran_reader {

namespace {

constexpr Components all_six = 63;

void mpc(CardFields& c, Deck& deck) {
  Mpc m;
  m.set = c.id(0, 2, "the number of the set");
  m.at = c.card().at;
  const auto term = [&](std::size_t row, std::size_t first) {
    const Field &point = c.field(row, first), &component = c.field(row, first + 1), &value = c.field(row, first + 2);
    if (point.blank()) {
      for (const Field* f : {&component, &value}) {
        if (!f->blank()) c.wrong("field-missing", f->at, "a term has no point");
      }
      return;
    }
    Mpc::Term t;
    t.freedom = c.freedom(point, component);
    t.coefficient = c.real(value, "the coefficient");
    t.at = value.at;
    m.terms.push_back(std::move(t));
  };
  for (std::size_t row = 0; row < c.card().rows(); ++row) {
    term(row, 3);
    term(row, 6);
    if (row > 0 && !c.blank(row, 2)) c.wrong("field-form", c.field(row, 2).at, "field 2 of a continuation is blank");
    if (!c.blank(row, 9)) c.wrong("field-form", c.field(row, 9).at, "field 9 is blank");
  }
  if (m.terms.empty()) {
    if (c.good()) c.wrong("field-missing", c.card().at, "the equation has no term");
  } else if (m.terms[0].coefficient == 0) {
    if (c.good())
      c.wrong("field-range", m.terms[0].at, "the first coefficient is zero, that of the dependent component");
  }
  if (c.good()) deck.mpcs.push_back(std::move(m));
}

void rbe2(CardFields& c, Deck& deck) {
  RigidElement r;
  r.id = c.id(0, 2, "the number of the element");
  r.a = c.id(0, 3, "GN");
  r.components = c.components(c.field(0, 4), "CM");
  r.components_at = c.field(0, 4).at;
  if (r.components == 0 && c.good()) c.wrong("field-missing", r.components_at, "CM names no component");
  // A real is the thermal expansion, and behind it may stand its temperature alone.
  int reals = 0;
  for (std::size_t index = 3; index < c.count(); ++index) {
    if (c.at(index).blank()) continue;
    if (c.at(index).form == Field::Form::real && ++reals <= 2) continue;
    if (reals > 0) {
      c.wrong("field-form", c.at(index).at, fmt::format("{} stands behind the thermal expansion", c.at(index).text),
              "grids stand before it");
      return;
    }
    if (c.at(index).is_word("THRU")) {
      c.wrong("field-form", c.at(index).at, "THRU is not allowed here");
      return;
    }
    r.dependent.push_back(c.reference(c.at(index), "GM", 1));
  }
  if (r.dependent.empty() && c.good()) c.wrong("field-missing", c.card().end, "no dependent grid is named");
  if (c.good()) deck.rigid.push_back(std::move(r));
}

void rjoint(CardFields& c, Deck& deck) {
  RigidElement r;
  r.kind = RigidElement::Kind::joint;
  r.id = c.id(0, 2, "the number of the element");
  r.a = c.id(0, 3, "GA");
  r.dependent = {c.id(0, 4, "GB")};
  r.components = c.components(c.field(0, 5), "CB");
  r.components_at = c.field(0, 5).at;
  if (c.blank(0, 5)) r.components = all_six;
  if (c.good()) deck.rigid.push_back(std::move(r));
}

int count(Components c) { return __builtin_popcount(c); }

void rbar(CardFields& c, Deck& deck) {
  RigidElement r;
  r.kind = RigidElement::Kind::bar;
  r.id = c.id(0, 2, "the number of the element");
  r.a = c.id(0, 3, "GA");
  r.dependent = {c.id(0, 4, "GB")};
  r.components_at = c.field(0, 5).at;
  r.free_a = c.components(c.field(0, 5), "CNA");
  r.free_b = c.components(c.field(0, 6), "CNB");
  r.tied_a = c.components(c.field(0, 7), "CMA");
  r.tied_b = c.components(c.field(0, 8), "CMB");
  if (!c.good()) return;
  if (r.free_a == 0 && r.free_b == 0) r.free_a = all_six;
  if (count(r.free_a) + count(r.free_b) != 6) {
    c.wrong("field-range", r.components_at, "CNA and CNB together are six components");
    return;
  }
  if (r.tied_a == 0 && r.tied_b == 0) r.tied_a = all_six & ~r.free_a, r.tied_b = all_six & ~r.free_b;
  if ((r.tied_a & r.free_a) || (r.tied_b & r.free_b)) {
    c.wrong("field-range", r.components_at, "a component is independent and dependent");
    return;
  }
  deck.rigid.push_back(std::move(r));
}

void spc(CardFields& c, Deck& deck) {
  const Reference set = c.id(0, 2, "the number of the set");
  for (const std::size_t first : {std::size_t{3}, std::size_t{6}}) {
    if (first == 6 && c.blank(0, 6)) {
      c.refuse_beside_blank(0, 6, 2, "a point");
      break;
    }
    Spc s;
    s.set = set, s.at = c.card().at;
    s.point = c.id(0, first, "the point");
    s.components = c.components(c.field(0, first + 1), "the components");
    s.components_at = c.field(0, first + 1).at;
    s.value = c.real(0, first + 2, "the displacement");
    if (s.value != 0)
      c.diagnostics().warning("field-range", c.field(0, first + 2).at,
                              "SPC: a displacement that is not zero counts as zero here");
    if (c.good()) deck.spcs.push_back(std::move(s));
  }
}

void spc1(CardFields& c, Deck& deck) {
  const Reference set = c.id(0, 2, "the number of the set");
  const Components components = c.components(c.field(0, 3), "the components");
  // A range may be far wider than the points that are in it, and is kept as one.
  bool alone = c.field(0, 5).is_word("THRU");
  for (std::size_t i = 5; i < c.count(); ++i) alone = alone && c.at(i).blank();
  if (alone) {
    const Reference first = c.id(0, 4, "the first point"), last = c.id(0, 6, "the last point");
    if (c.good() && last.id <= first.id)
      c.wrong("field-range", c.field(0, 5).at, "THRU stands between a number and a larger one", "1 THRU 9");
    if (c.good()) deck.spcs.push_back({set, first, components, c.field(0, 3).at, 0, c.card().at, last.id});
    return;
  }
  const std::vector<Reference> points = c.list(2, "the point");
  if (points.empty() && c.good()) c.wrong("field-missing", c.card().end, "no point is named");
  if (!c.good()) return;
  for (const Reference& p : points) deck.spcs.push_back({set, p, components, c.field(0, 3).at, 0, c.card().at, 0});
}

void sum(CardFields& c, Deck& deck) {
  SetSum s;
  s.set = c.id(0, 2, "the number of the set");
  s.of = c.list(1, "the number of a set");
  if (s.of.empty() && c.good()) c.wrong("field-missing", c.card().end, "no set is named");
  if (c.good()) (c.name() == "MPCADD" ? deck.mpc_sums : deck.spc_sums).push_back(std::move(s));
}

constexpr CardKind constraint_card_kinds[] = {
    {"MPC", mpc, list_in_rows},     {"MPCADD", sum, list_in_rows},       {"RBE2", rbe2, list_in_rows},
    {"RJOINT", rjoint, "xxxx----"}, {"RBAR", rbar, "xxxxxxxx|x-------"}, {"SPC", spc, "xxxxxxx-"},
    {"SPC1", spc1, list_in_rows},   {"SPCADD", sum, list_in_rows},
};

}  // namespace

std::span<const CardKind> constraint_cards() { return constraint_card_kinds; }

}  // namespace dynalin::nastran_reader

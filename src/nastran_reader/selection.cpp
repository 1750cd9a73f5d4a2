#include "nastran_reader/selection.h"

#include <fmt/format.h>

#include "nastran_reader/points.h"

namespace dynalin::nastran_reader {

std::set<int> sets_of(const std::optional<Selected>& selected, const std::vector<SetSum>& sums) {
  std::set<int> out;
  if (!selected) return out;
  bool sum = false;
  for (const SetSum& s : sums) {
    if (s.set.id != selected->id) continue;
    sum = true;
    for (const Reference& r : s.of) out.insert(r.id);
  }
  if (!sum) out.insert(selected->id);
  return out;
}

std::vector<const Point*> held_points(const Spc& s, const Points& points) {
  std::vector<const Point*> out;
  if (s.last == 0) {
    if (const Point* p = points.find(s.point.id)) out.push_back(p);
    return out;
  }
  for (const Point& p : points.all()) {
    if (s.point.id <= p.id && p.id <= s.last) out.push_back(&p);
  }
  return out;
}

std::vector<DependentFreedom> dependent_freedoms(const Deck& deck, const Points& points) {
  std::vector<DependentFreedom> out;
  const std::set<int> sets = sets_of(deck.control.mpc, deck.mpc_sums);
  for (const Mpc& m : deck.mpcs) {
    if (!sets.contains(m.set.id)) continue;
    if (const auto f = points.freedom(m.terms[0].freedom))
      out.push_back({*f, m.terms[0].freedom.point.at, fmt::format("MPC of set {}", m.set.id)});
  }
  const auto add = [&](const RigidElement& r, const Reference& grid, Components components, const char* card) {
    const Point* p = points.find(grid.id);
    if (!p || p->scalar) return;
    for (int c = 0; c < 6; ++c) {
      if (components >> c & 1) out.push_back({p->first + c, grid.at, fmt::format("{} {}", card, r.id.id)});
    }
  };
  for (const RigidElement& r : deck.rigid) {
    switch (r.kind) {
      case RigidElement::Kind::spider:
        for (const Reference& g : r.dependent) add(r, g, r.components, "RBE2");
        break;
      case RigidElement::Kind::joint:
        add(r, r.dependent[0], r.components, "RJOINT");
        break;
      case RigidElement::Kind::bar:
        add(r, r.a, r.tied_a, "RBAR");
        add(r, r.dependent[0], r.tied_b, "RBAR");
        break;
    }
  }
  return out;
}

}  // namespace dynalin::nastran_reader

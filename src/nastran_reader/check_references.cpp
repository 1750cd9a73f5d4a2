#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "nastran_reader/check.h"

namespace dynalin::nastran_reader {

namespace {

// Numbers of one kind, each once.
class Numbers {
 public:
  Numbers(std::string_view kind, Diagnostics& diagnostics) : kind_(kind), diagnostics_(diagnostics) {}
  void add(const Reference& id) {
    const auto [at, is_new] = seen_.emplace(id.id, id.at);
    if (!is_new)
      diagnostics_.error("duplicate-card-id", id.at, fmt::format("the {} {} is defined twice", kind_, id.id))
          .notes.push_back({at->second, "the first one"});
  }
  bool has(int id) const { return seen_.contains(id); }
  void need(const Reference& r, std::string_view by) {
    if (r.id > 0 && !has(r.id))
      diagnostics_.error("undefined-card-id", r.at,
                         fmt::format("{} refers to {} {}, which does not exist", by, kind_, r.id));
  }

 private:
  std::string_view kind_;
  Diagnostics& diagnostics_;
  std::map<int, Span> seen_;
};

class References {
 public:
  References(const Deck& deck, const Points& points, Diagnostics& diagnostics)
      : deck_(deck), points_(points), diagnostics_(diagnostics) {}

  void run() {
    elements();
    for (const Mass& m : deck_.masses) {
      grid(m.grid, "the mass");
      if (m.system.id != -1) system(m.system);
    }
    scalar_elements();
    bushes();
    for (const RigidElement& r : deck_.rigid) rigid(r);
    drawings();
    for (const PointLoad& l : deck_.point_loads) grid(l.grid, "the load"), system(l.system);
  }

 private:
  const Point* grid(const Reference& r, std::string_view by) {
    const Point* p = points_.find(r.id);
    if (!p) {
      diagnostics_.error("undefined-card-id", r.at,
                         fmt::format("{} refers to GRID {}, which does not exist", by, r.id));
    } else if (p->scalar) {
      diagnostics_.error("undefined-card-id", r.at, fmt::format("{} needs a GRID, and {} is a scalar point", by, r.id));
      return nullptr;
    }
    return p;
  }
  bool system(const Reference& r) {
    if (points_.system(r.id)) return true;
    // One that is defined and degenerate has been told.
    const bool defined =
        std::any_of(deck_.systems.begin(), deck_.systems.end(), [&](const System& s) { return s.id.id == r.id; });
    if (!defined) diagnostics_.error("undefined-card-id", r.at, fmt::format("there is no coordinate system {}", r.id));
    return false;
  }

  void elements() {
    Numbers ids("element", diagnostics_);
    for (const Mass& m : deck_.masses) ids.add(m.id);
    for (const ScalarElement& e : deck_.scalar_elements) ids.add(e.id);
    for (const Bush& b : deck_.bushes) ids.add(b.id);
    for (const RigidElement& r : deck_.rigid) ids.add(r.id);
    for (const UndeformedElement& e : deck_.undeformed) ids.add(e.id);
  }

  void scalar_elements() {
    for (const ScalarElement& e : deck_.scalar_elements) {
      if (e.property.id > 0) {
        const char* card = e.kind == ScalarElement::Kind::stiffness ? "PELAS"
                           : e.kind == ScalarElement::Kind::damping ? "PDAMP"
                                                                    : "PMASS";
        const auto all = deck_.scalar_properties.find(card);
        if (all == deck_.scalar_properties.end() || !all->second.contains(e.property.id))
          diagnostics_.error("undefined-card-id", e.property.at,
                             fmt::format("{} refers to {} {}, which does not exist", e.card, card, e.property.id));
      }
      for (const Freedom& f : e.ends) check_freedom(f, e.card, points_, diagnostics_);
    }
  }

  void bushes() {
    Numbers properties("PBUSH", diagnostics_);
    for (const BushProperty& p : deck_.bush_properties) properties.add(p.id);
    for (const Bush& b : deck_.bushes) {
      properties.need(b.property, "CBUSH");
      const Point* a = grid(b.a, "CBUSH");
      const Point* end = b.b.id > 0 ? grid(b.b, "CBUSH") : nullptr;
      const Point* toward = b.direction_grid ? grid(*b.direction_grid, "CBUSH") : nullptr;
      if (b.system) system(*b.system);
      if (b.offset_system) system(*b.offset_system);
      if (!a || b.system) continue;
      // What counts as coincident is a length without scale, as the card defines it.
      constexpr double coincident = 1e-4;
      if (b.b.id == 0 || (end && (end->position - a->position).norm() < coincident)) {
        diagnostics_.error(
            "bush-axes", b.id.at,
            b.b.id == 0 ? fmt::format("CBUSH {} has one end and no CID, so that its axes are open", b.id.id)
                        : fmt::format("CBUSH {} has coincident ends and no CID, so that its axes are open", b.id.id),
            "write 0 as CID for the basic system");
        continue;
      }
      if (!end) continue;
      const Vector3d x = end->position - a->position;
      if (!b.direction && !b.direction_grid) {
        sideways(b);
        continue;
      }
      const Vector3d v = b.direction ? Vector3d(a->axes * *b.direction)
                         : toward    ? Vector3d(toward->position - a->position)
                                     : x.unitOrthogonal();
      if (!(x.cross(v).norm() > 1e-8 * x.norm() * v.norm()))
        diagnostics_.error("bush-axes", b.id.at,
                           fmt::format("CBUSH {}: its orientation lies along the line between its ends", b.id.id));
    }
  }

  // Without an orientation only what acts along and about the line between the ends has a direction.
  void sideways(const Bush& b) {
    for (const BushProperty& p : deck_.bush_properties) {
      if (p.id.id != b.property.id) continue;
      for (const Eigen::Index k : {1, 2, 4, 5}) {
        if (p.stiffness[k] == 0 && p.damping[k] == 0) continue;
        diagnostics_.error("bush-axes", b.id.at,
                           fmt::format("CBUSH {} has no orientation and its PBUSH values across its axis", b.id.id),
                           "give a CID or an orientation");
        return;
      }
    }
  }

  void rigid(const RigidElement& r) {
    const char* card = r.kind == RigidElement::Kind::spider  ? "RBE2"
                       : r.kind == RigidElement::Kind::joint ? "RJOINT"
                                                             : "RBAR";
    const Point* a = grid(r.a, card);
    for (const Reference& d : r.dependent) {
      const Point* b = grid(d, card);
      if (d.id == r.a.id)
        diagnostics_.error("undefined-card-id", d.at,
                           fmt::format("{} {} connects GRID {} with itself", card, r.id.id, d.id));
      if (!a || !b || r.kind != RigidElement::Kind::joint) continue;
      const double distance = (a->position - b->position).norm();
      // As far as coordinates of eight columns can tell.
      if (distance > 1e-6 * extent())
        diagnostics_.error("apart-joint", r.id.at,
                           fmt::format("RJOINT {}: GRID {} and GRID {} are {:.6g} apart and should coincide", r.id.id,
                                       r.a.id, d.id, distance));
    }
  }

  double extent() {
    if (extent_ < 0) {
      extent_ = 0;
      for (const Point& p : points_.all()) extent_ = std::max(extent_, p.position.cwiseAbs().maxCoeff());
    }
    return extent_;
  }

  void drawings() {
    Numbers materials("MAT1", diagnostics_);
    for (const Material& m : deck_.materials) materials.add(m.id);
    Numbers shells("PSHELL", diagnostics_), rods("PROD", diagnostics_);
    for (const PlainProperty& p : deck_.plain_properties) {
      (p.card == "PSHELL" ? shells : rods).add(p.id);
      for (const Reference& m : p.materials) materials.need(m, p.card);
    }
    for (const UndeformedElement& e : deck_.undeformed) {
      for (const Reference& g : e.grids) grid(g, e.card);
      if (e.card == "CROD") rods.need(e.property, e.card);
      if (e.card == "CTRIA3" || e.card == "CQUAD4") shells.need(e.property, e.card);
    }
  }

  const Deck& deck_;
  const Points& points_;
  Diagnostics& diagnostics_;
  double extent_ = -1;
};

}  // namespace

bool check_freedom(const Freedom& f, std::string_view by, const Points& points, Diagnostics& diagnostics) {
  const Point* p = points.find(f.point.id);
  if (!p) {
    diagnostics.error("undefined-card-id", f.point.at,
                      fmt::format("{} refers to point {}, which does not exist", by, f.point.id));
    return false;
  }
  if (points.freedom(f)) return true;
  diagnostics.error("wrong-component", f.component_at.source ? f.component_at : f.point.at,
                    p->scalar
                        ? fmt::format("{}: {} is a scalar point, which has no component {}", by, p->id, f.component)
                        : fmt::format("{}: a component of GRID {} is missing", by, p->id));
  return false;
}

void check_references(const Deck& deck, const Points& points, Diagnostics& diagnostics) {
  References(deck, points, diagnostics).run();
}

void warn_of_unknown(const Deck& deck, Diagnostics& diagnostics) {
  for (const auto& [name, kept] : deck.unknown) {
    diagnostics.warning("unknown-card", kept.first,
                        kept.count == 1 ? fmt::format("{} is not known here", name)
                                        : fmt::format("{} is not known here and stands {} times", name, kept.count));
  }
}

void check_solvable(const Deck& deck, bool ignore_unknown, Diagnostics& diagnostics) {
  for (const auto& [name, kept] : deck.unknown) {
    if (ignore_unknown) break;
    diagnostics.error("unassembled-card", kept.first, fmt::format("{} is not known, and may change the result", name),
                      "--ignore-unknown solves the deck as if it were not there");
  }
  if (ignore_unknown) warn_of_unknown(deck, diagnostics);
  const int solution = deck.control.solution;
  if (solution != 0 && solution != 107 && solution != 108)
    diagnostics.error("case-selection", deck.control.solution_at,
                      fmt::format("SOL {} is not solved here, but 107 and 108 are", solution));
  // Parameters that change all matrices.
  for (const auto& [name, neutral] :
       {std::pair("G", 0.0), std::pair("CK1", 1.0), std::pair("CB1", 1.0), std::pair("CM1", 1.0)}) {
    if (deck.parameter(name, neutral) == neutral) continue;
    diagnostics.error("unassembled-card", deck.parameters.at(name).second,
                      fmt::format("PARAM,{} is not solved here", name));
  }
  for (const auto& [name, at] : deck.control.passed_over) {
    if (name == "K42GG" || name == "TFL" || name == "A2GG" || name == "NSM")
      diagnostics.error("unassembled-card", at, fmt::format("{} is not solved here", name));
  }
  // What only draws has no mass.
  for (const PlainProperty& p : deck.plain_properties) {
    double density = 0;
    for (const Material& m : deck.materials) {
      const bool of_it =
          std::any_of(p.materials.begin(), p.materials.end(), [&](const Reference& r) { return r.id == m.id.id; });
      if (of_it) density = std::max(density, std::abs(m.density));
    }
    const bool used = std::any_of(deck.undeformed.begin(), deck.undeformed.end(), [&](const UndeformedElement& e) {
      return e.property.id == p.id.id && e.card != "PLOTEL";
    });
    if (used && (p.added_mass != 0 || density != 0))
      diagnostics.error("unassembled-card", p.id.at,
                        fmt::format("{} {} gives its elements mass, which is not assembled here", p.card, p.id.id));
  }
}

}  // namespace dynalin::nastran_reader

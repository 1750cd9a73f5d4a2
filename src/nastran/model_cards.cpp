#include "nastran/model_cards.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace dynalin::nastran {

namespace {

void write_grid(const Grid& g, CardFile& file) {
  Card card = file.card("GRID");
  card.integer(g.id).blank().real(g.position.x).real(g.position.y).real(g.position.z);
  card.reference(g.displacement_system).word(g.fixed);
  file.add(card, g);
}

// Of all components.
void write_tie(const RigidElement& e, CardFile& file) {
  Card card = file.card("RBE2");
  card.integer(e.id).integer(e.independent).word("123456");
  for (const std::int64_t grid : e.dependent) card.integer(grid);
  file.add(card, e);
}

// Neighbours of one name are a range.
void write_scalar_points(const std::vector<ScalarPoint>& points, const FileOf& file_of) {
  for (std::size_t k = 0; k < points.size();) {
    std::size_t last = k;
    while (last + 1 < points.size() && points[last + 1].id == points[last].id + 1 &&
           points[last + 1].name == points[k].name && points[last + 1].body == points[k].body)
      ++last;
    CardFile& file = file_of(CardGroup::body, points[k]);
    file.heading("scalar points");
    Card card = file.card("SPOINT");
    card.integer(points[k].id);
    if (last > k) card.word("THRU").integer(points[last].id);
    file.add(card, points[k]);
    k = last + 1;
  }
}

// How far the points that define the axes of a system stand from its origin: about as far as the model reaches, so that
// their coordinates have digits for the axes left.
double arm(const Deck& deck) {
  double reach = 0;
  const auto take = [&](const Vec3<double>& p) {
    for (const double c : {p.x, p.y, p.z}) reach = std::max(reach, std::isfinite(c) ? std::abs(c) : 0.0);
  };
  for (const Grid& g : deck.grids) take(g.position);
  for (const CoordinateSystem& s : deck.systems) take(s.origin);
  return reach > 0 ? std::pow(10.0, std::ceil(std::log10(reach))) : 1;
}

void write_systems(const Deck& deck, const FileOf& file_of) {
  const double length = arm(deck);
  for (const CoordinateSystem& s : deck.systems) {
    CardFile& file = file_of(CardGroup::body, s);
    file.heading("coordinate systems");
    Card card = file.card("CORD2R");
    card.integer(s.id).integer(0);
    for (const Vec3<double>& p : {s.origin, s.origin + s.axes.z * length, s.origin + s.axes.x * length})
      card.real(p.x).real(p.y).real(p.z);
    file.add(card, s);
  }
}

void write_masses(const Deck& deck, const FileOf& file_of) {
  for (const ConcentratedMass& m : deck.masses) {
    CardFile& file = file_of(CardGroup::body, m);
    file.heading("masses");
    Card card = file.card("CONM2");
    card.integer(m.id).integer(m.grid).integer(0).real(m.mass).row();
    // The card has the products of inertia, which are the negative entries of the tensor.
    const Mat3<double>& J = m.inertia;
    const std::array<double, 6> values = {J(0, 0), -J(1, 0), J(1, 1), -J(2, 0), -J(2, 1), J(2, 2)};
    if (std::ranges::any_of(values, [](double v) { return v != 0; })) {
      for (const double v : values) card.real(v);
    }
    file.add(card, m);
  }
}

void write_ties(const std::vector<RigidElement>& ties, CardGroup group, const FileOf& file_of) {
  for (const RigidElement& e : ties) {
    CardFile& file = file_of(group, e);
    file.heading("rigid elements");
    write_tie(e, file);
  }
}

Card joint_card(const RigidJoint& j, const CardFile& file) {
  Card card = file.card("RJOINT");
  card.integer(j.id).integer(j.grid_A).integer(j.grid_B).word(j.components);
  return card;
}

Card bush_card(const Bush& b, const CardFile& file) {
  Card card = file.card("CBUSH");
  card.integer(b.id).integer(b.property).integer(b.grid_A).reference(b.grid_B).blank(3).integer(b.system);
  constexpr double half_way = 0.5;  // what holds without it
  if (b.location != half_way) card.real(b.location);
  return card;
}

void write_property(const Bush& b, CardFile& file) {
  const auto any = [](const std::array<double, 6>& values) {
    return std::ranges::any_of(values, [](double v) { return v != 0; });
  };
  Card card = file.card("PBUSH");
  card.integer(b.property);
  const auto values = [&](std::string_view what, const std::array<double, 6>& list) {
    card.word(what);
    for (const double v : list) card.real(v);
  };
  if (any(b.stiffness) || !any(b.damping)) values("K", b.stiffness);
  if (any(b.damping)) {
    if (any(b.stiffness)) card.blank();
    values("B", b.damping);
  }
  file.add(card, b);
}

void write_relation(const Relation& r, std::int64_t set, CardFile& file) {
  Card card = file.card("MPC");
  card.integer(set);
  for (std::size_t k = 0; k < r.terms.size(); ++k) {
    if (k > 0 && k % 2 == 0) card.blank(2);  // the end of a row and the beginning of the next
    const Relation::Term& t = r.terms[k];
    card.integer(t.dof.point).integer(t.dof.component).real(t.coefficient);
  }
  file.add(card, r);
}

// Cards that join bodies, or what scripts need to join them again: a set of fixed points for each.
class Connections {
 public:
  Connections(const ExportOptions& options, const FileOf& file_of)
      : options_(options),
        file_of_(file_of),
        broken_(options.export_spc_connectivity && options.file_name_style == FileStyle::C),
        set_(options.spc_set_connectivity) {}

  void write(const Deck& deck) {
    for (const RigidJoint& j : deck.rigid_joints) {
      CardFile& file = file_of_(CardGroup::body, j);
      file.heading("rigid joints");
      join(joint_card(j, file), j, j.grid_A, j.grid_B, j.components, file);
    }
    for (const Bush& b : deck.bushes) {
      CardFile& file = file_of_(CardGroup::body, b);
      file.heading("bushings");
      std::string components;
      for (std::size_t c = 0; c < 6; ++c) {
        if (b.stiffness[c] != 0 || b.damping[c] != 0) components += static_cast<char>('1' + c);
      }
      join(bush_card(b, file), b, b.grid_A, b.grid_B, components.empty() ? "123456" : components, file);
    }
    for (const Bush& b : deck.bushes) {
      CardFile& file = file_of_(CardGroup::property, b);
      file.heading("properties of bushings");
      write_property(b, file);
    }
  }

 private:
  void join(const Card& card, const Owner& owner, std::int64_t A, std::int64_t B, const std::string& components,
            CardFile& file) {
    if (!broken_) return file.add(card, owner);
    file.add_as_comment(card, owner);
    if (set_ == options_.spc_set) ++set_;
    Card fixed = file.card("SPC");
    fixed.integer(set_++).integer(A).word(components).real(0);
    if (B != 0) fixed.integer(B).word(components).real(0);
    file.add(fixed, owner);
  }

  const ExportOptions& options_;
  const FileOf& file_of_;
  bool broken_;
  std::int64_t set_;
};

}  // namespace

void normalize_relations(Deck& deck) {
  std::vector<Relation> kept;
  for (Relation& r : deck.relations) {
    std::vector<Relation::Term> terms;
    std::map<Dof, std::size_t> places;
    for (const Relation::Term& t : r.terms) {
      const auto [place, fresh] = places.emplace(t.dof, terms.size());
      if (fresh)
        terms.push_back(t);
      else
        terms[place->second].coefficient += t.coefficient;
    }
    std::erase_if(terms, [](const Relation::Term& t) { return t.coefficient == 0; });
    if (terms.empty()) continue;
    const auto most =
        std::ranges::max_element(terms, {}, [](const Relation::Term& t) { return std::abs(t.coefficient); });
    const double scale = most->coefficient;
    if (!r.terms.empty() && terms.front().dof != r.terms.front().dof) std::iter_swap(terms.begin(), most);
    for (Relation::Term& t : terms) t.coefficient /= scale;
    if (terms.size() == 1 && std::isfinite(scale)) {
      deck.fixed_points.push_back({r, terms.front().dof.point, std::to_string(terms.front().dof.component)});
    } else {
      r.terms = std::move(terms);
      kept.push_back(std::move(r));
    }
  }
  deck.relations = std::move(kept);
}

void write_model(const Deck& deck, const ExportOptions& options, const FileOf& file_of) {
  for (const Grid& g : deck.grids) {
    CardFile& file = file_of(CardGroup::body, g);
    file.heading("grid points");
    write_grid(g, file);
  }
  write_scalar_points(deck.scalar_points, file_of);
  write_systems(deck, file_of);
  write_masses(deck, file_of);
  write_ties(deck.rigid_elements, CardGroup::tie, file_of);
  Connections(options, file_of).write(deck);
  for (const Relation& r : deck.relations) {
    CardFile& file = file_of(CardGroup::body, r);
    file.heading("relations");
    write_relation(r, options.mpc_set, file);
  }
  for (const FixedPoint& f : deck.fixed_points) {
    CardFile& file = file_of(CardGroup::body, f);
    file.heading("fixed points");
    Card card = file.card("SPC");
    card.integer(options.spc_set).integer(f.point).word(f.components).real(0);
    file.add(card, f);
  }
  for (const InitialState& s : deck.initial_states) {
    CardFile& file = file_of(CardGroup::body, s);
    file.heading("initial conditions");
    Card card = file.card("TIC");
    card.integer(options.tic_set).integer(s.dof.point).integer(s.dof.component).real(s.displacement).real(s.velocity);
    file.add(card, s);
  }
}

void write_shapes(const Deck& deck, const FileOf& file_of) {
  for (const Grid& g : deck.shape_grids) {
    CardFile& file = file_of(CardGroup::shape, g);
    file.heading("grid points of graphics");
    write_grid(g, file);
  }
  write_ties(deck.shape_ties, CardGroup::shape, file_of);
  for (const Shell& s : deck.shells) {
    CardFile& file = file_of(CardGroup::shape, s);
    file.heading("graphics");
    Card card = file.card(s.grids.size() == 3 ? "CTRIA3" : "CQUAD4");
    card.integer(s.id).integer(s.property);
    for (const std::int64_t grid : s.grids) card.integer(grid);
    file.add(card, s);
  }
  for (const Line& l : deck.lines) {
    CardFile& file = file_of(CardGroup::shape, l);
    file.heading("graphics");
    Card card = file.card(l.property == 0 ? "PLOTEL" : "CROD");
    card.integer(l.id);
    if (l.property != 0) card.integer(l.property);
    card.integer(l.grid_A).integer(l.grid_B);
    file.add(card, l);
  }
  // A material for each number; grids of shapes do not move against each other, so its stiffness is without effect.
  std::vector<std::int64_t> materials;
  for (const ShapeProperty& p : deck.shape_properties) {
    CardFile& file = file_of(CardGroup::property, p);
    file.heading("properties of graphics");
    Card card = file.card(p.rod ? "PROD" : "PSHELL");
    card.integer(p.id).integer(p.material).real(p.thickness);
    file.add(card, p);
    if (std::ranges::find(materials, p.material) != materials.end()) continue;
    materials.push_back(p.material);
    Card material = file.card("MAT1");
    constexpr double modulus = 1, ratio = 0.3;
    material.integer(p.material).real(modulus).blank().real(ratio);
    file.add(material, p);
  }
}

}  // namespace dynalin::nastran

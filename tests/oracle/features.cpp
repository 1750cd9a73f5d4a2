// What a mechanism contains.
#include <algorithm>
#include <utility>

#include "mechanism.h"

namespace dynalin::oracle {

namespace {

const Variable* find_variable(const Mechanism& m, int id) {
  const auto found =
      std::find_if(m.variables.begin(), m.variables.end(), [id](const Variable& v) { return v.id == id; });
  return found == m.variables.end() ? nullptr : &*found;
}

// Walks an expression and, through VARVAL, the variables it refers to; every variable once.
template <class Visit>
void walk_through(const Mechanism& m, const Expr& e, std::vector<int>& seen, Visit&& visit) {
  walk(e, [&](const Node& n) {
    visit(n);
    if (n.op != Op::varval || std::find(seen.begin(), seen.end(), n.ids[0]) != seen.end()) return;
    seen.push_back(n.ids[0]);
    if (const Variable* v = find_variable(m, n.ids[0])) walk_through(m, v->function, seen, visit);
  });
}

// A reaction below at least `depth` VARVALs, one inside the other.
bool reads_reaction(const Mechanism& m, const Expr& e, int depth, int most) {
  bool found = false;
  walk(e, [&](const Node& n) {
    found = found || (depth <= 0 && (n.op == Op::joint || n.op == Op::motion));
    if (n.op != Op::varval || most == 0) return;
    if (const Variable* v = find_variable(m, n.ids[0]))
      found = found || reads_reaction(m, v->function, depth - 1, most - 1);
  });
  return found;
}

void note_force_features(const Mechanism& m, Features& f) {
  for (const Sforce& s : m.sforces) {
    f.deep_reaction = f.deep_reaction || reads_reaction(m, s.function, 3, 4);
    std::vector<int> seen;
    walk_through(m, s.function, seen, [&](const Node& n) {
      if (n.op == Op::joint || n.op == Op::motion) f.force_reads_reaction = true;
      if (n.op != Op::measure) return;
      const bool acceleration = n.measure >= Measure::ACCX && n.measure <= Measure::WDTM;
      const bool velocity = n.measure >= Measure::VX && n.measure <= Measure::WM;
      f.force_reads_acceleration = f.force_reads_acceleration || acceleration;
      f.force_reads_velocity = f.force_reads_velocity || velocity;
    });
  }
}

}  // namespace

Features features_of(const Mechanism& m) {
  Features f;
  for (const Body& body : m.bodies) {
    if (body.ref.kind == BodyKind::ground) continue;
    ++f.moving_bodies;
    f.massless += body.mass == 0 ? 1 : 0;
    f.point_masses += body.ref.kind == BodyKind::point_mass ? 1 : 0;
    f.separate_im = f.separate_im || body.im != 0;
  }
  // Independent loops: joints beyond a spanning forest of the bodies they connect.
  std::vector<std::pair<BodyRef, BodyRef>> leader;
  for (const Body& body : m.bodies) leader.push_back({body.ref, body.ref});
  const auto root = [&](int marker) -> BodyRef {
    const auto k = std::find_if(m.markers.begin(), m.markers.end(), [&](const Marker& a) { return a.id == marker; });
    return std::find_if(leader.begin(), leader.end(), [&](const auto& l) { return l.first == k->body; })->second;
  };
  for (const Joint& j : m.joints) {
    if (j.type == JointType::screw || j.type == JointType::rackpin) continue;  // beside a joint, or far from closing
    const BodyRef a = root(j.i), b = root(j.j);
    f.loops += a == b ? 1 : 0;
    for (auto& l : leader) l.second = l.second == a ? b : l.second;
  }
  f.motions = static_cast<int>(m.motions.size());
  for (const Gcon& g : m.gcons) f.velocity_constraints += g.of_rates ? 1 : 0;
  for (const Contact& c : m.contacts)
    (c.two_curves ? f.curves_on_curves
     : c.plane    ? f.planes_on_curves
     : c.axis     ? f.axes_on_curves
                  : f.points_on_curves) += 1;
  for (const Diff& d : m.diffs) (d.kind == DiffKind::algebraic ? f.algebraic_diffs : f.differential_states) += 1;
  for (const Tfsiso& t : m.tfsisos) f.differential_states += static_cast<int>(t.denominator.size()) - 1;
  for (const Lse& e : m.lses) {
    for (const NumberMatrix& a : m.matrices) f.differential_states += a.id == e.a ? a.rows : 0;
  }
  for (const Gse& e : m.gses) f.differential_states += e.states;
  f.inputs = static_cast<int>(m.pinput.variables.size());
  f.outputs = static_cast<int>(m.poutput.variables.size());
  f.units_factor = m.ucf != 1;
  note_force_features(m, f);
  for (const Variable& v : m.variables) {
    std::vector<int> seen;
    walk_through(m, v.function, seen, [](const Node&) {});
    f.algebraic_loop = f.algebraic_loop || std::find(seen.begin(), seen.end(), v.id) != seen.end();
  }
  return f;
}

}  // namespace dynalin::oracle

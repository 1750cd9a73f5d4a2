#include "static_models.h"

namespace dynalin::oracle {

int Draft::part(double mass, const Triple& at, const Triple& reuler, double radius) {
  const int id = next_body_++;
  const double inertia = mass * radius * radius;
  Body b;
  b.ref = {BodyKind::part, id};
  b.mass = mass, b.ip = {inertia, 1.1 * inertia, 1.2 * inertia, 0, 0, 0};
  b.cm = cm(id), b.qg = at, b.reuler = reuler;
  model_.mechanism.bodies.push_back(b);
  model_.mechanism.markers.push_back({b.cm, b.ref});
  return id;
}

int Draft::massless(const Triple& at) {
  const int id = next_body_++;
  Body b;
  b.ref = {BodyKind::part, id};
  b.qg = at;
  model_.mechanism.bodies.push_back(b);
  model_.mechanism.markers.push_back({cm(id), b.ref});
  return id;
}

int Draft::point_mass(double mass, const Triple& at) {
  const int id = next_body_++;
  Body b;
  b.ref = {BodyKind::point_mass, id};
  b.mass = mass, b.cm = cm(id), b.qg = at;
  model_.mechanism.bodies.push_back(b);
  model_.mechanism.markers.push_back({b.cm, b.ref});
  return id;
}

int Draft::marker(int body, const Triple& qp, const Triple& reuler) {
  const int id = 100000 + next();
  for (const Body& b : model_.mechanism.bodies) {
    if (b.ref.id == body) model_.mechanism.markers.push_back({id, b.ref, qp, reuler});
  }
  return id;
}

Triple Draft::at(int body) const {
  for (const Body& b : model_.mechanism.bodies) {
    if (b.ref.id == body) return b.qg;
  }
  return {};
}

int Draft::joint(JointType type, int i, int j) {
  const int id = next();
  model_.mechanism.joints.push_back({id, type, i, j});
  return id;
}

void Draft::spring(int i, int j, double k, double free, double preload) {
  model_.mechanism.springs.push_back({next(), Direction::translational, i, j, k, 0.05 * k, preload, free});
}

void Draft::torsion(int i, int j, double k, double free) {
  model_.mechanism.springs.push_back({next(), Direction::rotational, i, j, k, 0.05 * k, 0, free});
}

void Draft::along_z(int i, int j, const Expr& function) {
  model_.mechanism.sforces.push_back({next(), Direction::translational, Reaction::action_only, i, j, function});
}

void Draft::torque(int i, int j, const Expr& function) {
  model_.mechanism.sforces.push_back({next(), Direction::rotational, Reaction::on_j, i, j, function});
}

namespace {

LinearForce linear(int id, LinearKind kind, int i, int j) {
  LinearForce f;
  f.id = id, f.kind = kind, f.i = i, f.j = j;
  return f;
}

}  // namespace

void Draft::bushing(int i, int j, const std::array<double, 6>& k, const std::array<double, 6>& preload) {
  LinearForce f = linear(next(), LinearKind::bushing, i, j);
  for (std::size_t c = 0; c < 6; ++c) f.k[c][c] = k[c], f.c[c][c] = 0.02 * k[c];
  f.force = preload;
  model_.mechanism.linears.push_back(f);
}

void Draft::field(int i, int j, const std::array<double, 6>& k, const std::array<double, 6>& length) {
  LinearForce f = linear(next(), LinearKind::field, i, j);
  for (std::size_t c = 0; c < 6; ++c) f.k[c][c] = k[c];
  f.ratio = 0.02, f.length = length;
  model_.mechanism.linears.push_back(f);
}

void Draft::beam(int i, int j, double length, double section) {
  LinearForce f = linear(next(), LinearKind::beam, i, j);
  const double second = section * section / 12;
  f.beam = {length, section, 2 * second, second, second, 2.1e11, 8e10, 0, 0};
  f.ratio = 0.02;
  model_.mechanism.linears.push_back(f);
}

void Draft::force(int i, const std::array<std::optional<Expr>, 3>& components) {
  const int floating = marker(1, {}), axes = marker(1, {});
  for (Marker& m : model_.mechanism.markers) m.floating = m.floating || m.id == floating;
  GeneralForce f;
  f.id = next(), f.i = i, f.jfloat = floating, f.rm = axes;
  for (std::size_t c = 0; c < 3; ++c) f.component[c] = components[c];
  model_.mechanism.gforces.push_back(f);
}

void Draft::drive(int joint, double value, char freedom) {
  Motion m;
  m.id = next(), m.joint = joint, m.freedom = freedom;
  m.f.c[0] = value;
  model_.mechanism.motions.push_back(m);
}

std::vector<StaticModel> static_models() {
  using Kind = StaticModel (*)(int);
  std::vector<StaticModel> list;
  const auto add = [&](Kind kind, int count) {
    for (int k = 0; k < count; ++k) list.push_back(kind(k));
  };
  add(hanging_chain, 9);
  add(cable, 8);
  add(vehicle, 8);
  add(preloaded_loop, 6);
  add(stretched_body, 6);
  add(snapping_frame, 6);
  add(dropped_plate, 6);
  add(slider_between_stops, 5);
  add(indifferent, 6);
  add(held_by_nothing, 8);
  add(growing_force, 6);
  add(massless_between, 5);
  add(redundant_door, 4);
  add(bent_beam, 5);
  add(controlled, 5);
  add(geared, 5);
  add(driven_loop, 4);
  add(torsion_pendulum, 5);
  return list;
}

}  // namespace dynalin::oracle

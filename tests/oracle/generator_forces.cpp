// The force elements of a draw.
#include <algorithm>
#include <iterator>
#include <tuple>

#include "generator.h"

namespace dynalin::oracle {

void Draw::draw_springs() {
  const int count = 1 + pick(3);
  for (int k = 0; k < count; ++k) {
    const auto [i, j] = distant_pair(false);
    SpringDamper s{static_cast<int>(m_.springs.size()) + 1, Direction::translational, i, j, 0, 0, 0, 0};
    s.k = F_ / L_ * uniform(0.3, 6);
    s.c = F_ / L_ * uniform(0, 0.3);
    s.free = L_ * uniform(0.3, 1.5);
    s.preload = chance(0.5) ? F_ * uniform(-1, 1) : 0;
    m_.springs.push_back(s);
  }
  for (const Joint& joint : m_.joints) {
    if (joint.type != JointType::revolute || !chance(0.3)) continue;
    SpringDamper s{static_cast<int>(m_.springs.size()) + 1, Direction::rotational, joint.i, joint.j, 0, 0, 0, 0};
    s.k = F_ * L_ * uniform(0.1, 2);
    s.c = F_ * L_ * uniform(0, 0.2);
    s.free = uniform(-1, 1);
    s.preload = F_ * L_ * uniform(-0.5, 0.5);
    m_.springs.push_back(s);
  }
}

void Draw::draw_linear_forces() {
  const int count = pick(3);
  for (int n = 0; n < count; ++n) {
    LinearForce f;
    f.id = n + 1;
    f.kind = static_cast<LinearKind>(pick(3));
    std::tie(f.i, f.j) = distant_pair(true);
    if (body_of(f.i).kind == BodyKind::point_mass) continue;
    const auto unit = [&](std::size_t r, std::size_t c) { return F_ / L_ * (r < 3 ? 1 : L_) * (c < 3 ? 1 : L_); };
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) {
        if (f.kind == LinearKind::bushing && r != c) continue;
        const double diagonal = r == c ? 1 : 0;
        f.k[r][c] = unit(r, c) * (diagonal * uniform(0.2, 3) + (1 - diagonal) * uniform(-0.3, 0.3));
        f.c[r][c] = unit(r, c) * (diagonal * uniform(0, 0.2) + (1 - diagonal) * uniform(-0.03, 0.03));
      }
      f.force[r] = (r < 3 ? F_ : F_ * L_) * uniform(-0.5, 0.5);
      if (f.kind == LinearKind::field) f.length[r] = (r < 3 ? L_ : 1) * uniform(-0.6, 0.6);
      if (f.kind == LinearKind::beam) f.force[r] = 0;
    }
    const double L2 = L_ * L_, E = F_ / L2;
    f.beam = {L_ * uniform(0.5, 1.5),
              L2 * uniform(0.3, 2),
              L2 * L2 * uniform(0.05, 0.3),
              L2 * L2 * uniform(0.02, 0.1),
              L2 * L2 * uniform(0.02, 0.1),
              E,
              0.4 * E,
              chance(0.5) ? 1.2 : 0,
              chance(0.5) ? 1.5 : 0};
    if (f.kind != LinearKind::bushing && chance(0.5)) f.ratio = uniform(0, 0.05);
    for (std::size_t r = 0; r < 6 && f.kind == LinearKind::beam; ++r) {
      for (std::size_t c = 0; c < r; ++c) f.c[c][r] = f.c[r][c];
    }
    m_.linears.push_back(f);
  }
}

// Matrices are full and unsymmetric; the markers serve it alone.
void Draw::draw_nforces() {
  if (!chance(0.35)) return;
  std::vector<BodyRef> ends;
  std::copy_if(bodies_.begin(), bodies_.end(), std::back_inserter(ends),
               [](const BodyRef& b) { return b.kind != BodyKind::point_mass; });
  const auto marker_on = [&](const BodyRef& ref) {
    return add_marker(ref, {to_vec(body(ref).qg) + box(0.6 * L_), orientation()});
  };
  Nforce f;
  f.id = 1;
  const BodyRef base = one_of(ends);
  const std::size_t n = 1 + static_cast<std::size_t>(pick(3));
  for (int attempt = 0; attempt < 20 && f.i.size() < n; ++attempt) {
    const BodyRef end = one_of(ends);
    if (!are_one_body(end, base)) f.i.push_back(marker_on(end));
  }
  if (f.i.empty()) return;
  f.j = marker_on(base);
  const std::size_t size = 6 * f.i.size();
  const auto unit = [&](std::size_t r) { return r % 6 < 3 ? 1 : L_; };
  const auto table = [&](std::size_t columns, auto&& entry) {
    NumberMatrix a{next_matrix_++, static_cast<int>(size), static_cast<int>(columns), {}};
    for (std::size_t r = 0; r < size; ++r) {
      for (std::size_t c = 0; c < columns; ++c) a.values.push_back(entry(r, c));
    }
    m_.matrices.push_back(a);
    return a.id;
  };
  const auto square_table = [&](double diagonal, double others) {
    return table(size, [&](std::size_t r, std::size_t c) {
      const double value = r == c ? uniform(0.2, 1) * diagonal : uniform(-others, others);
      return F_ / L_ * unit(r) * unit(c) * value;
    });
  };
  f.k = square_table(3, 0.2);
  const int damping = pick(3);
  if (damping == 0) f.c = square_table(0.2, 0.03);
  if (damping == 1) f.ratio = uniform(0.01, 0.05);
  if (chance(0.6)) {
    f.length = table(1, [&](std::size_t r, std::size_t) { return (r % 6 < 3 ? L_ : 1) * uniform(-0.6, 0.6); });
  }
  if (chance(0.6)) f.force = table(1, [&](std::size_t r, std::size_t) { return F_ * unit(r) * uniform(-0.5, 0.5); });
  m_.nforces.push_back(f);
}

// The markers serve it alone; two that follow each other may be on one body.
void Draw::draw_cable() {
  Cable f;
  f.id = 1;
  const std::size_t n = 2 + static_cast<std::size_t>(pick(4));
  double length = 0;
  Vec last;
  for (std::size_t k = 0; k < n; ++k) {
    const BodyRef on = one_of(bodies_);
    const Vec at = to_vec(body(on).qg) + (on.kind == BodyKind::point_mass ? Vec{} : box(0.6 * L_));
    f.markers.push_back(add_marker(on, {at, orientation()}));
    if (k > 0) length += static_cast<double>(norm(at - last));
    last = at;
  }
  const bool joins =
      std::any_of(f.markers.begin(), f.markers.end(), [&](int m) { return body_of(m) != body_of(f.markers.front()); });
  f.k = F_ / L_ * uniform(0.3, 4);
  f.c = F_ / L_ * uniform(0, 0.3);
  f.length = length * uniform(0.7, 1);
  f.force = F_ * uniform(0.2, 1.5);
  if (joins) m_.cables.push_back(f);
}

// Off the middle by up to two thirds of a wide clearance. The markers serve it alone.
void Draw::draw_journal() {
  std::vector<BodyRef> ends;
  std::copy_if(bodies_.begin(), bodies_.end(), std::back_inserter(ends),
               [](const BodyRef& b) { return b.kind != BodyKind::point_mass; });
  const BodyRef shaft = one_of(ends), bearing = one_of(ends);
  if (shaft == bearing || shaft == ground) throw std::runtime_error("the seed wants a shaft in a bearing");
  Journal f;
  f.id = 1;
  f.radius = L_ * uniform(0.5, 1.5), f.length = L_ * uniform(0.5, 1.5), f.clearance = L_ * uniform(0.4, 1);
  f.viscosity = F_ / (L_ * f.radius) * std::pow(f.clearance / f.length, 3.0) * uniform(0.05, 0.5);
  f.speed = chance(0.5) ? uniform(-3, 3) : 0;
  const Vec at = 0.5L * (to_vec(body(shaft).qg) + to_vec(body(bearing).qg)) + box(0.3 * L_);
  const Mat R = orientation();
  const double away = f.clearance * uniform(0.1, 0.65), angle = uniform(-3, 3);
  const Vec offset{away * std::cos(angle), away * std::sin(angle), uniform(-0.3, 0.3) * L_};
  f.j = add_marker(bearing, {at, R}), f.i = add_marker(shaft, {at + R * offset, orientation()});
  m_.journals.push_back(f);
}

void Draw::draw_general_forces() {
  if (!chance(0.4)) return;
  GeneralForce f;
  f.id = 1;
  int j = 0;
  std::tie(f.i, j) = distant_pair(true);
  if (body_of(f.i).kind == BodyKind::point_mass || body_of(f.i) == ground) return;
  f.jfloat = add_floating(body_of(j));
  f.rm = one_of(oriented_);
  for (std::size_t k = 0; k < 6; ++k) {
    if (!chance(0.5)) continue;
    Expr e = constant(uniform(-0.4, 0.4)) + uniform(-0.4, 0.4) * shaped_kinematic() +
             uniform(-0.4, 0.4) * varval(one_of(features_));
    if (chance(0.3)) e = e + uniform(-0.15, 0.15) * reaction();
    if (!rates_.empty() && chance(0.3)) e = e + uniform(-0.2, 0.2) * rate();
    f.component[k] = (k < 3 ? F_ : 0.5 * F_ * L_) * e;
  }
  if (std::none_of(f.component.begin(), f.component.end(), [](const auto& c) { return c.has_value(); })) {
    f.component[0] = F_ * varval(one_of(features_));
  }
  m_.gforces.push_back(f);
}

void Draw::draw_sforces() {
  const int count = 2 + pick(3);
  for (int k = 0; k < count; ++k) {
    Sforce s;
    s.id = static_cast<int>(m_.sforces.size()) + 1;
    std::vector<Joint> hinges;
    std::copy_if(m_.joints.begin(), m_.joints.end(), std::back_inserter(hinges),
                 [](const Joint& j) { return j.type == JointType::revolute; });
    if (chance(0.4)) s.direction = Direction::rotational;
    if (chance(0.4)) s.reaction = Reaction::action_only;
    if (s.direction == Direction::rotational && s.reaction == Reaction::on_j && hinges.empty()) {
      s.reaction = Reaction::action_only;
    }
    std::tie(s.i, s.j) = distant_pair(true);
    if (s.direction == Direction::rotational && s.reaction == Reaction::on_j) {
      // Rotational forces want parallel z axes.
      const Joint& hinge = one_of(hinges);
      s.i = hinge.i;
      s.j = hinge.j;
    }
    if (body_of(s.i) == ground) std::swap(s.i, s.j);
    const bool on_point = body_of(s.i).kind == BodyKind::point_mass || body_of(s.j).kind == BodyKind::point_mass;
    if (on_point) {
      s.direction = Direction::translational;
      s.reaction = Reaction::on_j;
    }
    Expr e = constant(uniform(-0.6, 0.6)) + uniform(-0.6, 0.6) * varval(one_of(features_));
    if (chance(0.6)) e = e + uniform(-0.6, 0.6) * shaped_kinematic();
    if (k == 0 || chance(0.4)) e = e + uniform(0.3, 1) * varval(one_of(inputs_));
    if (chance(0.3)) e = e + uniform(-0.15, 0.15) * acceleration();
    if (chance(0.3)) e = e + uniform(-0.15, 0.15) * reaction();
    if (!states_.empty() && chance(0.5)) e = e + uniform(-0.7, 0.7) * one_of(states_);
    if (!rates_.empty() && chance(0.4)) e = e + uniform(-0.3, 0.3) * rate();
    s.function = (s.direction == Direction::rotational ? 0.5 * F_ * L_ : F_) * e;
    m_.sforces.push_back(s);
  }
}

}  // namespace dynalin::oracle

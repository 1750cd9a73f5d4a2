// Flexible bodies of a draw: nodes with masses and shapes at random, deformed and in motion where the dataset starts.
#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "generator.h"

namespace dynalin::oracle {

void Draw::draw_flexible() {
  Flexible f;
  f.id = 50 + static_cast<int>(m_.flexibles.size());
  const int count = 4 + pick(3);
  for (int k = 0; k < count; ++k) {
    Flexible::Node n;
    n.place = to_triple(box(0.8 * L_));
    n.mass = uniform(0.3, 1);
    const double s = n.mass * L_ * L_;
    const double x = s * uniform(0.02, 0.06), y = s * uniform(0.02, 0.06), z = s * uniform(0.02, 0.06);
    const Mat P = orientation();
    const Mat J = P * Mat{{Vec{y + z, 0, 0}, Vec{0, x + z, 0}, Vec{0, 0, x + y}}} * transpose(P);
    const auto entry = [&](std::size_t r, std::size_t c) {
      return static_cast<double>(component(J.column[c], static_cast<int>(r)));
    };
    n.inertia = {entry(0, 0), entry(1, 1), entry(2, 2), -entry(0, 1), -entry(0, 2), -entry(1, 2)};
    for (std::size_t mode = 0; mode < 3; ++mode)
      n.shift[mode] = to_triple(box(0.8)), n.turn[mode] = to_triple(box(0.8 / L_));
    f.nodes.push_back(n);
  }
  const double k = F_ / L_ * (must_spin_ ? 0.3 : 1);
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c <= r; ++c) {
      f.stiffness[r][c] = f.stiffness[c][r] = r == c ? k * uniform(8, 40) : k * uniform(-2, 2);
      f.damping[r][c] = f.damping[c][r] = r == c ? k * uniform(0.1, 0.4) : k * uniform(-0.04, 0.04);
    }
  }
  f.ratio = chance(0.6) ? uniform(0.005, 0.05) : 0;
  for (int load = 1 + pick(2); load > 0; --load) {
    std::array<double, 9> column{};
    for (std::size_t c = 0; c < 9; ++c) column[c] = uniform(-0.5, 0.5) * F_ * (c >= 3 && c < 6 ? L_ : 1);
    f.loads.push_back(column);
  }
  m_.flexibles.push_back(f);
  const auto add = [&](const BodyRef& ref, const Vec& at, const Mat& axes) {
    Body body;
    body.ref = ref, body.qg = to_triple(at), body.reuler = angles_313(axes);
    m_.bodies.push_back(body);
  };
  add(f.frame(), box(L_), orientation());
  const Body placed = m_.bodies.back();
  const Vec q = box(0.15 * L_);
  add(f.modes(), q, Mat{});
  m_.bodies.back().reuler = {};
  for (const std::size_t node : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    const Flexible::Node& n = f.nodes[node];
    const Mat R = rotation_313(placed.reuler);
    const auto along = [&](const std::array<Triple, 3>& by) {
      return q.x * to_vec(by[0]) + q.y * to_vec(by[1]) + q.z * to_vec(by[2]);
    };
    add(f.node(node), to_vec(placed.qg) + R * (to_vec(n.place) + along(n.shift)),
        R * rotation_exponential(along(n.turn)));
  }
  join_flexible(f);
}

// One node or two on what else there is.
void Draw::join_flexible(const Flexible& f) {
  std::vector<BodyRef> solid;
  for (const BodyRef& ref : bodies_) {
    if (ref == ground || (ref.kind == BodyKind::part && body(ref).mass > 0)) solid.push_back(ref);
  }
  const auto join = [&](std::size_t node) {
    connect(f.node(node), one_of(solid),
            one_of(std::vector{JointType::fixed, JointType::revolute, JointType::spherical, JointType::universal,
                               JointType::cylindrical, JointType::planar}));
  };
  if (!chance(0.15)) join(0);
  if (chance(0.3)) join(1);
  // Tables of energy are compared where no curves are seen: every second seed has none here.
  if (!may_rub_) ride_on(f.node(2), solid);
  for (const std::size_t node : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    const BodyRef ref = f.node(node);
    const int id = add_marker(ref, {to_vec(body(ref).qg) + box(0.3 * L_), orientation()});
    all_.push_back(id), oriented_.push_back(id), bodies_.push_back(ref);
  }
}

// A curve on a node, and a body that follows it.
void Draw::ride_on(const BodyRef& node, const std::vector<BodyRef>& solid) {
  const bool two_curves = chance(0.5);
  for (int attempt = 0; attempt < 20 && mobility() > 2; ++attempt) {
    const Mechanism before = m_;
    const int marker = next_marker_, matrix = next_matrix_;
    try {
      return place_contact(one_of(solid), node, two_curves);
    } catch (const std::runtime_error&) {
      m_ = before;
      next_marker_ = marker, next_matrix_ = matrix;
    }
  }
}

void Draw::draw_flexibles() {
  if (!must_deform_) return;
  std::swap(random_, flexible_random_);
  draw_flexible();
  std::swap(random_, flexible_random_);
}

void Draw::draw_modal_forces() {
  if (!must_deform_) return;
  std::swap(random_, flexible_random_);
  const Flexible& f = m_.flexibles[0];
  for (std::size_t load = 0; load < f.loads.size(); ++load) {
    ModalForce force{static_cast<int>(load) + 1, f.id, static_cast<int>(load), 0, {}};
    if (chance(0.5)) {
      const BodyRef on = body_of(one_of(oriented_));
      if (!is_elastic(on.kind)) force.jfloat = add_floating(on);
    }
    force.scale = constant(uniform(-0.5, 0.5)) + uniform(-0.6, 0.6) * shaped_kinematic() +
                  uniform(-0.4, 0.4) * varval(one_of(features_));
    if (!states_.empty() && chance(0.4)) force.scale = force.scale + uniform(-0.5, 0.5) * one_of(states_);
    m_.mforces.push_back(force);
  }
  // What reacts on the body as if that were rigid, and on a node of it.
  react_on(f.frame(), 11), react_on(f.node(static_cast<std::size_t>(pick(3))), 12);
  std::swap(random_, flexible_random_);
  check();
}

void Draw::react_on(const BodyRef& body, int id) {
  std::vector<int> elsewhere;
  std::copy_if(oriented_.begin(), oriented_.end(), std::back_inserter(elsewhere),
               [&](int m) { return body_of(m) != ground && !of_flexible(body_of(m).kind); });
  GeneralForce f;
  f.id = id;
  f.i = one_of(elsewhere), f.jfloat = add_floating(body), f.rm = one_of(oriented_);
  for (std::size_t k = 0; k < 6; ++k) {
    if (k != 1 && !chance(0.5)) continue;
    const Expr e = constant(uniform(-0.4, 0.4)) + uniform(-0.4, 0.4) * shaped_kinematic() +
                   uniform(-0.4, 0.4) * varval(one_of(features_));
    f.component[k] = (k < 3 ? F_ : 0.5 * F_ * L_) * e;
  }
  m_.gforces.push_back(f);
}

}  // namespace dynalin::oracle

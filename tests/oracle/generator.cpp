// Random mechanisms. Bodies and joint frames are placed in the global frame first and then expressed on
// their bodies, so that loops close as drawn; velocities are projected onto the constraints. Quantities are
// drawn in natural units (a length, a force that moves a unit mass at ten lengths per time squared) so
// that every unit system gives equally gentle numbers.
#include <algorithm>
#include <iterator>
#include <numbers>
#include <random>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "model.h"

namespace dynalin::oracle {

namespace {

Triple angles_313(const Mat& R) {
  const auto& c = R.column;
  return to_triple({std::atan2(c[2].x, -c[2].y), std::atan2(std::hypot(c[2].x, c[2].y), c[2].z),
                    std::atan2(c[0].z, c[1].z)});
}

struct Frame {
  Vec p;
  Mat R;
};

constexpr BodyRef ground{BodyKind::ground, 1};

class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t attempt)
      : random_(seed * 1000003U + attempt * 7919U + 17U),
        wanted_loops_(seed % 10 == 0 ? 2 : (seed % 5 < 2 ? 1 : 0)),
        wanted_motions_(seed % 3 == 0 ? 1 : 0) {}
  [[nodiscard]] Mechanism mechanism();

 private:
  // Randomness: the standard distributions differ between libraries, the bits do not.
  double uniform(double a, double b) {
    return a + (b - a) * std::ldexp(static_cast<double>(random_() >> 11U), -53);
  }
  bool chance(double p) { return uniform(0, 1) < p; }
  int pick(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  template <class T>
  const T& one_of(const std::vector<T>& list) {
    return list[static_cast<std::size_t>(pick(static_cast<int>(list.size())))];
  }
  Vec box(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Mat orientation() { return rotation_313(uniform(-3, 3), uniform(0.2, 2.9), uniform(-3, 3)); }

  void draw_units();
  void add_body(BodyKind kind);
  int add_marker(const BodyRef& body, const Frame& global);
  void connect(const BodyRef& i_body, const BodyRef& j_body, JointType type);
  void draw_tree();
  void draw_loops();
  void draw_motions();
  void draw_massless();
  void draw_measure_markers();
  void draw_velocities();
  void draw_springs();
  void draw_controls();
  void draw_differential_elements();
  void draw_sforces();
  void draw_outputs();
  void check_structure() const;
  void check() const;
  void check_nodes(const Model& model, const Expr& e) const;

  Expr displacement();
  Expr velocity();
  Expr acceleration();
  Expr reaction();
  Expr kinematic() { return chance(0.5) ? displacement() : velocity(); }
  Expr shaped(const Expr& x);
  Expr feature(int self);
  std::pair<int, int> distant_pair(bool oriented_j);
  [[nodiscard]] BodyRef body_of(int marker) const;
  [[nodiscard]] const Body& body(const BodyRef& ref) const;
  [[nodiscard]] int mobility() const;
  int variable(const Expr& e) {
    m_.variables.push_back({next_variable_, e});
    return next_variable_++;
  }

  std::mt19937_64 random_;
  // Rejection starves loops and motions; some seeds insist on them.
  int wanted_loops_ = 0, wanted_motions_ = 0;
  Mechanism m_;
  double L_ = 1, F_ = 10;  // natural length and force
  std::vector<BodyRef> bodies_{ground};
  std::vector<std::pair<BodyRef, BodyRef>> connected_;
  std::vector<int> oriented_;  // measure markers on ground and parts
  std::vector<int> all_;       // those and the ones on point masses
  std::vector<int> features_, inputs_;
  std::vector<Expr> states_;   // DIF and ARYVAL of what the control elements offer
  int next_marker_ = 1, next_variable_ = 1, next_array_ = 1, next_matrix_ = 1;
};

void Draw::draw_units() {
  const double r = uniform(0, 1);
  if (r >= 0.5) m_.ucf = r < 0.75 ? 1000 : 386.0885826771654;
  L_ = m_.ucf == 1 ? 1 : (m_.ucf == 1000 ? 1000 : 30);
  F_ = 10 * L_ / m_.ucf;
  const Vec g = box(9 * L_);
  m_.gravity = to_triple(g);
  m_.bodies.push_back({});
  m_.bodies[0].ref = ground;
}

const Body& Draw::body(const BodyRef& ref) const {
  return *std::find_if(m_.bodies.begin(), m_.bodies.end(), [&](const Body& b) { return b.ref == ref; });
}

BodyRef Draw::body_of(int marker) const {
  return std::find_if(m_.markers.begin(), m_.markers.end(), [&](const Marker& k) { return k.id == marker; })->body;
}

int Draw::add_marker(const BodyRef& ref, const Frame& global) {
  const Body& owner = body(ref);
  const Mat R = rotation_313(owner.reuler[0], owner.reuler[1], owner.reuler[2]);
  Marker marker;
  marker.id = next_marker_++;
  marker.body = ref;
  marker.qp = to_triple(transpose(R) * (global.p - to_vec(owner.qg)));
  marker.reuler = angles_313(transpose(R) * global.R);
  m_.markers.push_back(marker);
  return marker.id;
}

void Draw::add_body(BodyKind kind) {
  Body b;
  b.ref = {kind, static_cast<int>(m_.bodies.size()) + 1};
  b.qg = to_triple(box(L_));
  b.reuler = angles_313(orientation());
  b.mass = uniform(0.7, 3);
  m_.bodies.push_back(b);
  bodies_.push_back(b.ref);
  const Frame cm{to_vec(b.qg) + box(0.35 * L_), orientation()};
  const int cm_id = add_marker(b.ref, cm);
  Body& added = m_.bodies.back();
  added.cm = cm_id;
  if (kind == BodyKind::point_mass) return;
  // Principal moments from positive second moments satisfy the triangle inequality.
  const double s = b.mass * L_ * L_;
  const double x = s * uniform(0.02, 0.2), y = s * uniform(0.02, 0.2), z = s * uniform(0.02, 0.2);
  const Mat P = orientation();
  Mat J = P * Mat{{Vec{y + z, 0, 0}, Vec{0, x + z, 0}, Vec{0, 0, x + y}}} * transpose(P);
  if (chance(0.25)) {
    const Frame im{cm.p + box(0.3 * L_), orientation()};
    added.im = add_marker(b.ref, im);
    const Mat to_im = transpose(im.R) * cm.R;
    const Mat S = skew(transpose(im.R) * (cm.p - im.p));
    J = to_im * J * transpose(to_im) + -static_cast<Real>(b.mass) * (S * S);
  }
  const Triple d{static_cast<double>(J.column[0].x), static_cast<double>(J.column[1].y),
                 static_cast<double>(J.column[2].z)};
  m_.bodies.back().ip = {d[0], d[1], d[2], -static_cast<double>(J.column[1].x),
                         -static_cast<double>(J.column[2].x), -static_cast<double>(J.column[2].y)};
}

void Draw::connect(const BodyRef& i_body, const BodyRef& j_body, JointType type) {
  Frame J{0.5L * (to_vec(body(i_body).qg) + to_vec(body(j_body).qg)) + box(0.4 * L_), orientation()};
  Frame I = J;
  switch (type) {
    case JointType::revolute:
      I.R = J.R * rotation_z(uniform(-2.2, 2.2));
      break;
    case JointType::translational:
      I.p += static_cast<Real>(L_ * uniform(-0.7, 0.7)) * J.R.column[2];
      break;
    case JointType::spherical:
      I.R = orientation();
      break;
    case JointType::universal:
      // A quarter turn about any axis in the x-y plane of J leaves z_I normal to z_J.
      I.R = J.R * rotation_z(uniform(-3, 3)) * rotation_x(std::numbers::pi_v<Real> / 2) * rotation_z(uniform(-3, 3));
      break;
    case JointType::fixed:
      break;
  }
  const int i = add_marker(i_body, I);
  const int j = add_marker(j_body, J);
  m_.joints.push_back({static_cast<int>(m_.joints.size()) + 1, type, i, j});
  connected_.emplace_back(i_body, j_body);
}

int Draw::mobility() const {
  int count = 0;
  for (const Body& b : m_.bodies) {
    count += b.ref.kind == BodyKind::part ? 6 : (b.ref.kind == BodyKind::point_mass ? 3 : 0);
  }
  constexpr int removed[] = {5, 5, 3, 4, 6};
  for (const Joint& j : m_.joints) count -= removed[static_cast<int>(j.type)];
  return count - static_cast<int>(m_.motions.size());
}

void Draw::draw_tree() {
  const int n = 2 + pick(5);
  std::vector<BodyRef> parents{ground};
  for (int k = 0; k < n; ++k) {
    const bool mass_point = k > 0 && chance(0.12);
    add_body(mass_point ? BodyKind::point_mass : BodyKind::part);
    const BodyRef child = bodies_.back();
    const BodyRef parent = chance(0.65) ? parents.back() : one_of(parents);
    if (mass_point) {
      if (chance(0.5)) connect(child, parent, JointType::spherical);
      continue;
    }
    parents.push_back(child);
    if (mobility() < 10 && chance(0.06)) continue;  // free, held by springs alone
    const double r = uniform(0, 1);
    const JointType type = r < 0.42   ? JointType::revolute
                           : r < 0.55 ? JointType::spherical
                           : r < 0.72 ? JointType::universal
                           : r < 0.92 ? JointType::translational
                                      : JointType::fixed;
    if (chance(0.5)) {
      connect(child, parent, type);
    } else {
      connect(parent, child, type);
    }
  }
}

void Draw::draw_loops() {
  if (wanted_loops_ == 0 && !chance(0.5)) return;
  const int wanted = std::max(wanted_loops_, 1 + pick(2));
  int closed = 0;
  for (int attempt = 0; attempt < 12 && closed < wanted; ++attempt) {
    const BodyRef a = one_of(bodies_), b = one_of(bodies_);
    const bool joined = std::any_of(connected_.begin(), connected_.end(), [&](const auto& c) {
      return (c.first == a && c.second == b) || (c.first == b && c.second == a);
    });
    if (a == b || joined || a.kind == BodyKind::point_mass || b.kind == BodyKind::point_mass) continue;
    const double r = uniform(0, 1);
    const JointType type = r < 0.5 ? JointType::spherical : (r < 0.8 ? JointType::universal : JointType::revolute);
    const int removed = type == JointType::spherical ? 3 : (type == JointType::universal ? 4 : 5);
    if (mobility() - removed < 1) continue;
    connect(a, b, type);
    ++closed;
  }
}

void Draw::draw_motions() {
  for (const Joint& joint : m_.joints) {
    const bool drivable = joint.type == JointType::revolute || joint.type == JointType::translational;
    if (!drivable || !chance(0.2) || mobility() < 2) continue;
    const Model model(m_);
    const MarkerMotion& i = model.markers()[static_cast<std::size_t>(model.marker_index(joint.i))];
    const MarkerMotion& j = model.markers()[static_cast<std::size_t>(model.marker_index(joint.j))];
    const bool turns = joint.type == JointType::revolute;
    const Real now = turns ? std::atan2(dot(i.axis[0], j.axis[1]), dot(i.axis[0], j.axis[0]))
                           : dot(i.p - j.p, j.axis[2]);
    const double size = turns ? 1 : L_;
    TimeFunction f;
    f.c = {0, size * uniform(-2, 2), size * uniform(-3, 3), size * uniform(-2, 2)};
    if (chance(0.6)) {
      f.amplitude = size * uniform(0.1, 0.6);
      f.frequency = uniform(1, 4);
      f.phase = uniform(-2, 2);
    }
    f.c[0] = static_cast<double>(now - motion_values(f, 0)[0]);
    m_.motions.push_back({static_cast<int>(m_.motions.size()) + 1, joint.id, f});
  }
}

void Draw::draw_massless() {
  if (!chance(0.6)) return;
  std::vector<std::size_t> candidates;
  for (std::size_t b = 0; b < m_.bodies.size(); ++b) {
    if (m_.bodies[b].ref.kind != BodyKind::part) continue;
    int links = 0;
    for (std::size_t k = 0; k < m_.joints.size(); ++k) {
      if (connected_[k].first != m_.bodies[b].ref && connected_[k].second != m_.bodies[b].ref) continue;
      const int id = m_.joints[k].id;
      const bool driven = std::any_of(m_.motions.begin(), m_.motions.end(), [&](const Motion& a) { return a.joint == id; });
      links += driven || m_.joints[k].type == JointType::fixed ? 2 : 1;
    }
    if (links >= 2) candidates.push_back(b);
  }
  if (candidates.empty()) return;
  Body& light = m_.bodies[one_of(candidates)];
  light.mass = 0;
  light.ip = {};
  light.im = 0;
  if (chance(0.6)) light.cm = 0;
}

void Draw::draw_measure_markers() {
  for (const BodyRef& ref : bodies_) {
    const Vec centre = ref == ground ? Vec{} : to_vec(body(ref).qg);
    for (int k = 0; k < 2; ++k) {
      const int id = add_marker(ref, {centre + box(0.6 * L_), orientation()});
      all_.push_back(id);
      if (ref.kind != BodyKind::point_mass) oriented_.push_back(id);
    }
  }
}

void Draw::draw_velocities() {
  Model model(m_);
  const Stated free{std::vector<bool>(model.bodies.size(), false), std::vector<bool>(model.bodies.size(), false)};
  for (std::size_t b = 1; b < model.bodies.size(); ++b) {
    model.motion[b].v = box(1.5 * L_);
    model.motion[b].w = model.bodies[b].dof == 6 ? box(2.5) : Vec{};
  }
  model.update_velocities();
  complete_velocities(model, free);
  model.update_velocities();
  for (Body& b : m_.bodies) {
    if (b.cm == 0) continue;
    const MarkerMotion& cm = model.markers()[static_cast<std::size_t>(model.marker_index(b.cm))];
    b.v = to_triple(cm.v);
    if (b.ref.kind == BodyKind::part) b.w = to_triple(transpose(Mat{cm.axis}) * cm.w);
  }
}

// ------------------------------------------------------------------------------------ expressions

std::pair<int, int> Draw::distant_pair(bool oriented_j) {
  const Model model(m_);
  for (int attempt = 0; attempt < 200; ++attempt) {
    const int i = one_of(all_), j = one_of(oriented_j ? oriented_ : all_);
    if (body_of(i) == body_of(j)) continue;
    const Vec d = model.markers()[static_cast<std::size_t>(model.marker_index(i))].p -
                  model.markers()[static_cast<std::size_t>(model.marker_index(j))].p;
    if (norm(d) > 0.4 * L_) return {i, j};
  }
  throw std::runtime_error("no two markers are far enough apart");
}

Expr Draw::displacement() {
  const auto [i, j] = distant_pair(true);
  if (chance(0.25) && body_of(i).kind != BodyKind::point_mass) {
    return measure(static_cast<Measure>(static_cast<int>(Measure::AX) + pick(3)), {i, j});
  }
  if (chance(0.3)) return (1 / L_) * measure(Measure::DM, {i, j});
  const auto kind = static_cast<Measure>(pick(3));
  const double r = uniform(0, 1);
  if (r < 0.3) return (1 / L_) * measure(kind, {i});
  if (r < 0.5) return (1 / L_) * measure(kind, {i, j});
  return (1 / L_) * measure(kind, {i, r < 0.6 ? 0 : j, one_of(oriented_)});
}

Expr Draw::velocity() {
  const auto [i, j] = distant_pair(true);
  const double r = uniform(0, 1);
  if (r < 0.2) return (0.5 / L_) * measure(Measure::VR, {i, j});
  if (r < 0.25) return (0.5 / L_) * measure(Measure::VM, {i, j});
  if (r < 0.55 && body_of(i).kind != BodyKind::point_mass) {
    return 0.4 * measure(static_cast<Measure>(static_cast<int>(Measure::WX) + pick(3)), {i, j, one_of(oriented_)});
  }
  const auto kind = static_cast<Measure>(static_cast<int>(Measure::VX) + pick(3));
  if (r < 0.7) return (0.5 / L_) * measure(kind, {i});
  if (r < 0.85) return (0.5 / L_) * measure(kind, {i, j, one_of(oriented_)});
  return (0.5 / L_) * measure(kind, {i, j, one_of(oriented_), one_of(oriented_)});
}

Expr Draw::acceleration() {
  const auto [i, j] = distant_pair(true);
  const double r = uniform(0, 1);
  if (r < 0.05) return (0.05 / L_) * measure(Measure::ACCM, {i, j});
  if (r < 0.4 && body_of(i).kind != BodyKind::point_mass) {
    const auto kind = static_cast<Measure>(static_cast<int>(Measure::WDTX) + pick(3));
    if (r < 0.2) return 0.03 * measure(kind, {i, j, one_of(oriented_)});
    return 0.03 * measure(kind, {i, j, one_of(oriented_), one_of(oriented_)});
  }
  const auto kind = static_cast<Measure>(static_cast<int>(Measure::ACCX) + pick(3));
  if (r < 0.7) return (0.05 / L_) * measure(kind, {i});
  if (r < 0.85) return (0.05 / L_) * measure(kind, {i, j, one_of(oriented_)});
  return (0.05 / L_) * measure(kind, {i, j, one_of(oriented_), one_of(oriented_)});
}

Expr Draw::reaction() {
  if (m_.joints.empty()) return acceleration();
  const Joint& joint = one_of(m_.joints);
  const bool transmits_torque = joint.type != JointType::spherical;
  const double r = uniform(0, 1);
  const int rm = chance(0.4) ? 0 : one_of(oriented_);
  if (r < 0.1) return (0.2 / F_) * joint_reaction(joint.id, pick(2), 1, rm);
  if (transmits_torque && r < 0.15) return (0.2 / (F_ * L_)) * joint_reaction(joint.id, pick(2), 5, rm);
  if (transmits_torque && r < 0.5) return (0.2 / (F_ * L_)) * joint_reaction(joint.id, pick(2), 6 + pick(3), rm);
  return (0.2 / F_) * joint_reaction(joint.id, pick(2), 2 + pick(3), rm);
}

// A smooth function of an argument of order one, so that second and higher derivatives matter.
Expr Draw::shaped(const Expr& x) {
  switch (pick(8)) {
    case 0:
      return call(Function::sin, {x});
    case 1:
      return call(Function::cos, {x});
    case 2:
      return call(Function::tanh, {x});
    case 3:
      return call(Function::sqrt, {constant(1) + square(x)});
    case 4:
      return call(Function::exp, {constant(-0.5) * square(x)});
    case 5:
      return call(Function::atan2, {x, constant(1) + square(kinematic())});
    case 6:
      return x / (constant(1) + square(x));
    default:
      return x;
  }
}

Expr Draw::feature(int self) {
  Expr sum = constant(uniform(-0.5, 0.5));
  const int terms = 1 + pick(3);
  for (int k = 0; k < terms; ++k) {
    Expr term = shaped(kinematic());
    if (chance(0.3)) term = term * shaped(kinematic());
    sum = sum + uniform(-0.6, 0.6) * term;
  }
  if (chance(0.4)) sum = sum + uniform(-0.25, 0.25) * shaped(acceleration());
  if (chance(0.4)) sum = sum + uniform(-0.25, 0.25) * shaped(reaction());
  if (chance(0.5)) sum = sum + uniform(-0.3, 0.3) * shaped(varval(one_of(features_)));
  if (chance(0.15)) sum = sum + uniform(-0.3, 0.3) * call(Function::sin, {varval(self) + time_now()});
  if (!states_.empty() && chance(0.4)) sum = sum + uniform(-0.5, 0.5) * one_of(states_);
  if (chance(0.2)) sum = sum + uniform(-0.4, 0.4) * varval(one_of(inputs_));
  return sum;
}

// --------------------------------------------------------------------------------------- elements

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

void Draw::draw_differential_elements() {
  const auto inputs_of = [&](int n) {
    Array u{next_array_++, ArrayKind::u, {}, {}};
    for (int k = 0; k < n; ++k) u.variables.push_back(chance(0.3) ? one_of(inputs_) : one_of(features_));
    m_.arrays.push_back(u);
    return u.id;
  };
  const auto owned = [&](ArrayKind kind) {
    m_.arrays.push_back({next_array_, kind, {}, {}});
    return next_array_++;
  };
  const auto matrix = [&](int rows, int columns, double size) {
    NumberMatrix a{next_matrix_++, rows, columns, {}};
    for (int k = 0; k < rows * columns; ++k) a.values.push_back(uniform(-size, size));
    m_.matrices.push_back(a);
    return a.id;
  };
  if (chance(0.45)) {
    const int order = 1 + pick(3);
    Tfsiso t;
    t.id = 1;
    t.u = inputs_of(1);
    t.x = owned(ArrayKind::x);
    t.y = owned(ArrayKind::y);
    for (int k = 0; k <= order; ++k) t.denominator.push_back(uniform(0.5, 3));
    const int numerator_order = pick(order + 1);
    for (int k = 0; k <= numerator_order; ++k) t.numerator.push_back(uniform(-1, 1));
    m_.tfsisos.push_back(t);
    states_.push_back(aryval(t.y, 1));
    states_.push_back(aryval(t.x, order));
  }
  if (chance(0.35)) {
    const int n = 1 + pick(3), inputs = 1 + pick(2);
    Lse e;
    e.id = 1;
    e.u = inputs_of(inputs);
    e.x = owned(ArrayKind::x);
    e.y = owned(ArrayKind::y);
    e.a = matrix(n, n, 1.5);
    e.b = matrix(n, inputs, 1);
    e.c = matrix(2, n, 0.7);
    if (chance(0.5)) e.d = matrix(2, inputs, 0.3);
    if (chance(0.6)) {
      Array ic{next_array_++, ArrayKind::ic, {}, {}};
      for (int k = 0; k < n; ++k) ic.numbers.push_back(uniform(-1, 1));
      m_.arrays.push_back(ic);
      e.ic = ic.id;
    }
    m_.lses.push_back(e);
    states_.push_back(aryval(e.y, 1 + pick(2)));
  }
  const int diffs = chance(0.5) ? 1 + pick(2) : 0;
  for (int k = 1; k <= diffs; ++k) {
    m_.diffs.push_back({k, uniform(-1, 1), {}});
    states_.push_back(dif(k));
  }
}

void Draw::draw_controls() {
  const int inputs = 1 + pick(2), features = 2 + pick(3);
  for (int k = 0; k < inputs; ++k) inputs_.push_back(variable(constant(0)));
  for (int k = 0; k < features; ++k) features_.push_back(variable(constant(0)));
  draw_differential_elements();
  for (const int id : features_) m_.variables[static_cast<std::size_t>(id - 1)].function = feature(id);
  for (const int id : inputs_) {
    if (chance(0.2)) {
      m_.variables[static_cast<std::size_t>(id - 1)].function = uniform(-0.5, 0.5) * shaped(kinematic());
    }
  }
  for (Diff& d : m_.diffs) {
    d.function = uniform(-1.5, 0.5) * dif(d.id) + uniform(-1, 1) * varval(one_of(features_)) +
                 uniform(-0.5, 0.5) * shaped(dif(d.id) * kinematic());
    if (chance(0.3)) d.function = d.function + uniform(-0.5, 0.5) * varval(one_of(inputs_));
    if (chance(0.3)) d.function = d.function + uniform(-0.5, 0.5) * acceleration();
  }
  m_.pinput = {1, inputs_};
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
    if (chance(0.6)) e = e + uniform(-0.6, 0.6) * shaped(kinematic());
    if (k == 0 || chance(0.4)) e = e + uniform(0.3, 1) * varval(one_of(inputs_));
    if (chance(0.3)) e = e + uniform(-0.15, 0.15) * acceleration();
    if (chance(0.3)) e = e + uniform(-0.15, 0.15) * reaction();
    if (!states_.empty() && chance(0.5)) e = e + uniform(-0.7, 0.7) * one_of(states_);
    s.function = (s.direction == Direction::rotational ? 0.5 * F_ * L_ : F_) * e;
    m_.sforces.push_back(s);
  }
}

void Draw::draw_outputs() {
  std::vector<int> outputs;
  outputs.push_back(variable(displacement()));
  outputs.push_back(variable(velocity()));
  outputs.push_back(variable(acceleration()));
  outputs.push_back(variable(reaction()));
  const Sforce& s = one_of(m_.sforces);
  const bool line = s.direction == Direction::translational;
  const int flag = s.reaction == Reaction::action_only ? 0 : pick(2);
  const int rm = chance(0.5) ? 0 : one_of(oriented_);
  outputs.push_back(variable((line ? 1 / F_ : 1 / (F_ * L_)) * sforce_load(s.id, flag, (line ? 2 : 6) + pick(3), rm)));
  outputs.push_back(one_of(features_));
  if (!states_.empty()) outputs.push_back(variable(one_of(states_)));
  if (chance(0.2)) outputs.push_back(one_of(inputs_));
  m_.poutput = {1, outputs};
}

// ---------------------------------------------------------------------------------------- rejection

// Rejects the draw when a measure or a reaction stands near the place where it has no derivative.
void Draw::check_nodes(const Model& model, const Expr& e) const {
  const Node& n = *e.node;
  const auto require = [](bool good) {
    if (!good) throw std::runtime_error("a measure is near a singularity");
  };
  if (n.op == Op::joint && (n.ids[2] == 1 || n.ids[2] == 5)) {
    require(model.evaluate(e) > 0.2 * F_ * (n.ids[2] == 5 ? 0.5 * L_ : 1));
  }
  if (n.op == Op::measure && n.measure >= Measure::AX) {
    const MarkerMotion& i = model.markers()[static_cast<std::size_t>(model.marker_index(n.ids[0]))];
    const MarkerMotion& j = model.markers()[static_cast<std::size_t>(model.marker_index(n.ids[1]))];
    const Vec& of_i = n.measure == Measure::AZ ? i.axis[0] : i.axis[2];
    const Vec& normal = j.axis[static_cast<std::size_t>(static_cast<int>(n.measure) - static_cast<int>(Measure::AX))];
    const Real off = dot(of_i, normal);
    require(1 - off * off > 0.1L && std::fabs(model.evaluate(e)) < 2.9L);
  }
  if (n.op == Op::measure && (n.measure == Measure::VM)) require(model.evaluate(e) > 0.5 * L_);
  if (n.op == Op::measure && (n.measure == Measure::ACCM)) require(model.evaluate(e) > 3 * L_);
  for (const Expr& argument : n.arguments) check_nodes(model, argument);
}

// How the dependent coordinates follow the chosen ones, and how massive the chosen ones are.
void check_conditioning(Model& model, const std::vector<ChosenState>& states) {
  const Dense G = model.gradient();
  const auto n = static_cast<std::size_t>(model.dofs);
  Dense P(n, n);
  std::vector<Real> scale(n, 1);
  for (const Model::BodyData& b : model.bodies) {
    for (int c = 0; c < std::min(3, b.dof); ++c) scale[static_cast<std::size_t>(b.offset + c)] = model.length;
  }
  for (std::size_t k = 0; k < G.rows(); ++k) {
    for (std::size_t j = 0; j < n; ++j) P(k, j) = G(k, j) * scale[j];
  }
  std::size_t row = G.rows();
  for (const ChosenState& s : states) {
    if (s.kind != ChosenState::Kind::coordinate) continue;
    const BodyRef ref{s.is_point_mass ? BodyKind::point_mass : BodyKind::part, s.body_id};
    const auto b = static_cast<std::size_t>(model.body_index(ref));
    P(row++, static_cast<std::size_t>(model.bodies[b].offset + s.coordinate)) = 1;
  }
  const Lu lu(P);
  std::vector<std::vector<Real>> N;
  for (std::size_t k = G.rows(); k < n; ++k) {
    std::vector<Real> unit(n, 0);
    unit[k] = 1;
    N.push_back(lu.solve(unit));
    for (const Real v : N.back()) {
      if (std::fabs(v) > 8) throw std::runtime_error("the constraints are badly conditioned");
    }
  }
  const Dense M = model.mass_matrix();
  const std::size_t f = N.size();
  Dense R(f, f);
  for (std::size_t a = 0; a < f; ++a) {
    for (std::size_t i = 0; i < n; ++i) {
      Real sum = 0;
      for (std::size_t j = 0; j < n; ++j) sum += M(i, j) * scale[j] * N[a][j];
      for (std::size_t b = 0; b < f; ++b) R(b, a) += N[b][i] * scale[i] * sum;
    }
  }
  // Pivots of the reduced mass matrix: a small one is an admissible motion that carries hardly any mass.
  Real largest = 0;
  for (std::size_t k = 0; k < f; ++k) largest = std::max(largest, R(k, k));
  for (std::size_t k = 0; k < f; ++k) {
    if (R(k, k) < 3e-3L * largest) throw std::runtime_error("an admissible motion carries no mass");
    for (std::size_t i = k + 1; i < f; ++i) {
      const Real factor = R(i, k) / R(k, k);
      for (std::size_t j = k; j < f; ++j) R(i, j) -= factor * R(k, j);
    }
  }
}

void Draw::check_structure() const {
  if (mobility() < 1 || mobility() > 9) throw std::runtime_error("the mobility is out of range");
  const Features f = features_of(m_);
  if (f.loops < wanted_loops_) throw std::runtime_error("the seed wants more loops");
  if (f.motions < wanted_motions_) throw std::runtime_error("the seed wants a motion");
}

void Draw::check() const {
  Model model(m_);
  const OraclePoint point = drawn_point(m_);
  place(model, point);
  const Dense G = model.gradient();
  if (independent_rows(G, 0.02L).size() != G.rows()) throw std::runtime_error("constraints are nearly redundant");
  check_conditioning(model, choose_states(m_, point));
  for (const Row& row : model.rows) {
    if (row.type == Row::Type::angle && std::fabs(model.row_position(row)) > 1e-12L) {
      throw std::runtime_error("a motion does not start where the joint is");
    }
  }
  for (const BodyMotion& b : model.motion) {
    if (norm(b.w) > 8 || norm(b.v) > 6 * L_) throw std::runtime_error("a body moves too fast");
  }
  solve_algebra(model);
  for (const BodyMotion& b : model.motion) {
    if (norm(b.al) > 150 || norm(b.a) > 150 * L_) throw std::runtime_error("a body accelerates too fast");
  }
  for (const Variable& v : m_.variables) check_nodes(model, v.function);
  for (const Sforce& s : m_.sforces) check_nodes(model, s.function);
  for (const Diff& d : m_.diffs) check_nodes(model, d.function);
}

Mechanism Draw::mechanism() {
  draw_units();
  draw_tree();
  draw_loops();
  draw_motions();
  check_structure();
  draw_massless();
  draw_measure_markers();
  draw_velocities();
  draw_springs();
  draw_controls();
  draw_sforces();
  draw_outputs();
  check();
  return m_;
}

}  // namespace

Mechanism random_mechanism(std::uint64_t seed) {
  for (std::uint64_t attempt = 0; attempt < 2000; ++attempt) {
    try {
      Mechanism m = Draw(seed, attempt).mechanism();
      m.title = "Random mechanism, seed " + std::to_string(seed);
      return m;
    } catch (const std::runtime_error&) {
      // Rejected: the next draw of the same seed.
    }
  }
  throw std::runtime_error("no acceptable mechanism for this seed");
}

}  // namespace dynalin::oracle

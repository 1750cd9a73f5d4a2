// The part of a draw that reads: expressions, forces, control elements, inputs and outputs.
#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <tuple>

#include "generator.h"

namespace dynalin::oracle {

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
  if (r < 0.3) return (1 / L_) * measure(kind, {moving(i, j)});
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
  if (r < 0.7) return (0.5 / L_) * measure(kind, {moving(i, j)});
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
  if (r < 0.7) return (0.05 / L_) * measure(kind, {moving(i, j)});
  if (r < 0.85) return (0.05 / L_) * measure(kind, {i, j, one_of(oriented_)});
  return (0.05 / L_) * measure(kind, {i, j, one_of(oriented_), one_of(oriented_)});
}

Expr Draw::reaction() {
  if (m_.joints.empty()) return acceleration();
  if (!m_.linears.empty() && chance(0.3)) return load();
  const Joint& joint = one_of(m_.joints);
  if (is_gcon(joint.type)) return acceleration();
  using enum JointType;
  const bool transmits_torque =
      joint.type != spherical && joint.type != atpoint && joint.type != inline_ && joint.type != inplane;
  const bool transmits_force = joint.type != orientation && joint.type != parallel_axes && joint.type != perpendicular;
  const double r = transmits_force ? uniform(0, 1) : uniform(0.1, 0.5);
  const int rm = chance(0.4) ? 0 : one_of(oriented_);
  const auto component = [&](int flag, int comp) {
    return is_primitive(joint.type) ? primitive_reaction(joint.id, flag, comp, rm)
                                    : joint_reaction(joint.id, flag, comp, rm);
  };
  if (r < 0.1) return (0.2 / F_) * component(pick(2), 1);
  if (transmits_torque && r < 0.15) return (0.2 / (F_ * L_)) * component(pick(2), 5);
  if (transmits_torque && r < 0.5) return (0.2 / (F_ * L_)) * component(pick(2), 6 + pick(3));
  return (0.2 / F_) * component(pick(2), 2 + pick(3));
}

Expr Draw::load() {
  const LinearForce& f = one_of(m_.linears);
  const int comp = 1 + pick(8), flag = pick(2), rm = chance(0.4) ? 0 : one_of(oriented_);
  return (0.2 / (comp > 4 ? F_ * L_ : F_)) * linear_load(f.kind, f.id, flag, comp, rm);
}

// A smooth function of an argument of order one, so that second and higher derivatives matter.
Expr Draw::shaped(const Expr& x) {
  switch (pick(9)) {
    case 8: {
      // Points between the whole numbers.
      SplinePoints p{static_cast<int>(m_.splines.size()) + 1, {}, {}};
      for (int k = -4; k < 4; ++k) p.x.push_back(k + 0.5), p.y.push_back(uniform(-0.8, 0.8));
      m_.splines.push_back(p);
      return spline_at(x, p.id, chance(0.5));
    }
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
    f.ratio = uniform(0, 0.05);
    m_.linears.push_back(f);
  }
}

void Draw::draw_general_forces() {
  if (!chance(0.4)) return;
  GeneralForce f;
  f.id = 1;
  int j = 0;
  std::tie(f.i, j) = distant_pair(true);
  if (body_of(f.i).kind == BodyKind::point_mass || body_of(f.i) == ground) return;
  Marker floating;
  floating.id = next_marker_++;
  floating.body = body_of(j);
  floating.floating = true;
  m_.markers.push_back(floating);
  f.jfloat = floating.id;
  f.rm = one_of(oriented_);
  for (std::size_t k = 0; k < 6; ++k) {
    if (!chance(0.5)) continue;
    Expr e = constant(uniform(-0.4, 0.4)) + uniform(-0.4, 0.4) * shaped(kinematic()) +
             uniform(-0.4, 0.4) * varval(one_of(features_));
    if (chance(0.3)) e = e + uniform(-0.15, 0.15) * reaction();
    f.component[k] = (k < 3 ? F_ : 0.5 * F_ * L_) * e;
  }
  if (std::none_of(f.component.begin(), f.component.end(), [](const auto& c) { return c.has_value(); })) {
    f.component[0] = F_ * varval(one_of(features_));
  }
  m_.gforces.push_back(f);
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
  // Three variables deep.
  const int first = variable(shaped(varval(one_of(features_))) + uniform(-0.3, 0.3) * shaped(kinematic()));
  const int second = variable(shaped(varval(first)) * varval(first));
  features_.push_back(variable(shaped(varval(second)) + uniform(-0.2, 0.2) * varval(first)));
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
    if (chance(0.4))
      d.coefficient = constant(uniform(1, 2)) + uniform(-0.3, 0.3) * shaped(kinematic()) + 0.1 * square(dif(d.id));
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
  if (!m_.linears.empty()) outputs.push_back(variable(load()));
  if (!m_.gforces.empty()) {
    const int comp = 2 + pick(3) + 4 * pick(2);
    outputs.push_back(variable((1 / (comp > 4 ? F_ * L_ : F_)) *
                               gforce_load(general_statement(m_.gforces[0]), 1, pick(2), comp, one_of(oriented_))));
  }
  if (!states_.empty()) outputs.push_back(variable(one_of(states_)));
  if (chance(0.2)) outputs.push_back(one_of(inputs_));
  m_.poutput = {1, outputs};
}

}  // namespace dynalin::oracle

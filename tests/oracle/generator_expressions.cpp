// What a draw reads: measures, loads, and functions of them.
#include <algorithm>
#include <stdexcept>

#include "generator.h"

namespace dynalin::oracle {

// ------------------------------------------------------------------------------------------- atoms

std::pair<int, int> Draw::distant_pair(bool oriented_j) {
  for (int attempt = 0; attempt < 200; ++attempt) {
    const int i = one_of(all_), j = one_of(oriented_j ? oriented_ : all_);
    if (are_one_body(body_of(i), body_of(j))) continue;
    if (norm(place_of(i) - place_of(j)) > 0.4 * L_) return {i, j};
  }
  throw std::runtime_error("no two markers are far enough apart");
}

Expr Draw::angle() {
  for (int attempt = 0; attempt < 50; ++attempt) {
    const auto [i, j] = distant_pair(true);
    if (body_of(i).kind == BodyKind::point_mass) continue;
    const int kind = pick(13);
    if (kind >= 10) {
      return axis_component(static_cast<Measure>(static_cast<int>(Measure::UVX) + kind - 10), i, j, pick(3));
    }
    if (kind == 9) {
      const auto [k, unused] = distant_pair(false);
      if (k == i || k == j) continue;
      return 0.5 * measure(Measure::INCANG, {i, j, k});
    }
    return 0.5 * measure(static_cast<Measure>(static_cast<int>(Measure::AX) + kind), {i, j});
  }
  throw std::runtime_error("no pair of markers for an angle");
}

Expr Draw::displacement() {
  const auto [i, j] = distant_pair(true);
  if (chance(0.3)) return angle();
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
  if (r < 0.3 && body_of(i).kind != BodyKind::point_mass) return 0.4 * measure(Measure::WM, {i, j});
  if (r < 0.55 && body_of(i).kind != BodyKind::point_mass) {
    return 0.4 * measure(static_cast<Measure>(static_cast<int>(Measure::WX) + pick(3)), {i, j, one_of(oriented_)});
  }
  const auto kind = static_cast<Measure>(static_cast<int>(Measure::VX) + pick(3));
  if (r < 0.7) return (0.5 / L_) * measure(kind, {moving(i, j)});
  if (r < 0.85) return (0.5 / L_) * measure(kind, {i, j, one_of(oriented_)});
  return (0.5 / L_) * measure(kind, {i, j, one_of(oriented_), one_of(oriented_)});
}

Expr Draw::acceleration() {
  if (here_ && !floating_.empty() && chance(0.2)) return at_contact(2);
  const auto [i, j] = distant_pair(true);
  const double r = uniform(0, 1);
  if (r < 0.05) return (0.05 / L_) * measure(Measure::ACCM, {i, j});
  if (r < 0.1 && body_of(i).kind != BodyKind::point_mass) return 0.03 * measure(Measure::WDTM, {i, j});
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
  if (!m_.linears.empty() && chance(0.2)) return load();
  if (!m_.contacts.empty() && chance(0.3)) return contact_load();
  if (chance(0.25)) return net_load();
  if (!m_.motions.empty() && chance(0.3)) {
    const Motion& m = one_of(m_.motions);
    const bool force = m.freedom >= 'T';
    return (0.2 / (force ? F_ : F_ * L_)) *
           motion_reaction(m.id, pick(2), (force ? 2 : 6) + pick(3), one_of(oriented_));
  }
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

Expr Draw::contact_load() {
  const Contact& c = one_of(m_.contacts);
  const int rm = chance(0.4) ? 0 : one_of(floating_.empty() || chance(0.5) ? oriented_ : floating_);
  const bool torque = (c.axis || c.floats_on_i()) && chance(0.3);  // there is none about a single point
  const int comp = torque ? 6 + pick(3) : 2 + pick(3);
  const double scale = 0.2 / (torque ? F_ * L_ : F_);
  if (!c.plane && !c.axis && chance(0.6)) {
    const bool magnitude = !torque && chance(0.2);
    return scale * contact_reaction(c.two_curves, c.id, pick(2), magnitude ? 1 : comp, rm);
  }
  const int i = c.floats_on_i() ? c.ifloat : c.i;
  const bool swap = chance(0.5);
  return scale * marker_load(comp, swap ? c.jfloat : i, chance(0.5) ? 0 : swap ? i : c.jfloat, rm);
}

// Of a spring by its name; of a joint or a spring by its markers.
Expr Draw::net_load() {
  const int rm = chance(0.4) ? 0 : one_of(oriented_);
  const SpringDamper& spring = one_of(m_.springs);
  const bool line = spring.direction == Direction::translational;
  const int force = chance(0.15) ? 1 : 2 + pick(3), torque = chance(0.15) ? 5 : 6 + pick(3);
  if (chance(0.3)) {
    return (0.2 / (line ? F_ : F_ * L_)) * spring_load(spring.id, pick(2), line ? force : torque, rm);
  }
  if (m_.joints.empty() || chance(0.4)) {
    const bool swap = chance(0.5);
    const int i = swap ? spring.j : spring.i, j = swap ? spring.i : spring.j;
    return (0.2 / (line ? F_ : F_ * L_)) * marker_load(line ? force : torque, i, chance(0.5) ? 0 : j, rm);
  }
  const Joint& joint = one_of(m_.joints);
  if (is_gcon(joint.type)) return acceleration();
  const bool swap = chance(0.5), forces = joint.type < JointType::orientation && chance(0.7);
  const bool torques = joint.type != JointType::spherical && joint.type != JointType::atpoint &&
                       joint.type != JointType::inline_ && joint.type != JointType::inplane;
  const int comp = forces || !torques ? force : torque;
  return (0.2 / (comp < 5 ? F_ : F_ * L_)) * marker_load(comp, swap ? joint.j : joint.i,
                                                         chance(0.5) ? 0
                                                         : swap      ? joint.i
                                                                     : joint.j,
                                                         rm);
}

// --------------------------------------------------------------------------------------- functions

Expr Draw::shaped(const Expr& x) {
  switch (pick(12)) {
    case 0:
      if (!m_.curves.empty() && chance(0.4)) {
        // Near the middle of the open ones.
        return (0.8 / L_) * curve_at(0.7 * call(Function::sin, {x}), pick(3), 1 + pick(3), one_of(m_.curves).id);
      }
      return chance(0.25) ? signal(x) : interpolated(x);
    case 1:
      return call(Function::sin, {x});
    case 2:
      return call(Function::cos, {x});
    case 3:
      return call(Function::tanh, {x});
    case 4:
      return call(Function::sqrt, {constant(1) + square(x)});
    case 5:
      return call(Function::exp, {constant(-0.5) * square(x)});
    case 6:
      return call(Function::atan2, {x, constant(1) + square(kinematic())});
    case 7:
      return x / (constant(1) + square(x));
    case 8:
      return series(x);
    case 9:
    case 10:
      return curved(x);
    default:
      return x;
  }
}

// Points between the whole numbers, of one curve or two.
Expr Draw::interpolated(const Expr& x) {
  SplinePoints p{static_cast<int>(m_.splines.size()) + 1, {}, {}, {}, {}};
  const bool family = chance(0.3);
  for (int k = -4; k < 4; ++k) {
    p.x.push_back(k + 0.5);
    p.y.push_back(uniform(-0.8, 0.8));
    if (family) p.beyond.push_back(uniform(-0.8, 0.8));
  }
  if (family) p.z = {uniform(-1, -0.5), uniform(0.5, 1)};
  m_.splines.push_back(p);
  if (family) return surface_at(x, kinematic(), p.id, chance(0.5) ? Interpolation::akima : Interpolation::cubic);
  return spline_at(x, p.id, static_cast<Interpolation>(pick(4)), chance(0.2) ? 1 : 0);
}

// Of a density on one to five cycles per unit of x, from before its first point to behind its last.
Expr Draw::signal(const Expr& x) {
  SplinePoints p{static_cast<int>(m_.splines.size()) + 1, {}, {}, {}, {}};
  for (int k = 0; k < 5; ++k) {
    p.x.push_back(0.1 + 0.1 * k);
    p.y.push_back(uniform(0.2, 1));
  }
  m_.splines.push_back(p);
  return signal_of(x, p.id, uniform(0, 0.2), uniform(0.3, 0.6), 2 + pick(5), pick(1000));
}

Expr Draw::series(const Expr& x) {
  std::vector<Expr> list{x, constant(uniform(-0.5, 0.5))};
  const auto coefficients = [&](double size) {
    for (int k = 2 + pick(3); k > 0; --k) list.push_back(constant(uniform(-size, size)));
  };
  switch (pick(5)) {
    case 0:
      list[0] = call(Function::tanh, {x});
      coefficients(0.4);
      return call(Function::poly, list);
    case 1:
      list[0] = call(Function::tanh, {x});
      coefficients(0.3);
      return call(Function::cheby, list);
    case 2:
      list.push_back(constant(uniform(0.3, 1)));
      coefficients(0.4);
      return call(Function::forsin, list);
    case 3:
      list.push_back(constant(uniform(0.3, 1)));
      coefficients(0.4);
      return call(Function::forcos, list);
    default:
      for (const auto& [low, high] : {std::pair{-0.8, 0.8}, {0.4, 1.5}, {-1.0, 1.0}, {-0.5, 0.5}}) {
        list.push_back(constant(uniform(low, high)));
      }
      return call(Function::shf, list);
  }
}

Expr Draw::curved(const Expr& x) {
  const Expr bounded = call(Function::sin, {x});
  switch (pick(9)) {
    case 0:
      return call(Function::tan, {0.6 * bounded});
    case 1:
      return call(Function::asin, {0.7 * bounded});
    case 2:
      return call(Function::acos, {0.7 * bounded});
    case 3:
      return call(Function::log, {constant(1.5) + square(x)});
    case 4:
      return call(Function::log10, {constant(1.5) + bounded});
    case 5:
      return call(Function::raise, {constant(1.5) + bounded, constant(uniform(0.5, 2.5)) + 0.3 * bounded});
    case 6:
      return call(Function::sinh, {bounded});
    case 7:
      return call(Function::cosh, {bounded});
    default:
      return call(Function::atan, {x});
  }
}

Expr Draw::shaped_kinematic() {
  const Expr x = kinematic();
  if (!here_ || !chance(0.5)) return shaped(x);
  const double value = now(x);
  if (!std::isfinite(value) || std::fabs(value) > 3) return shaped(x);
  return in_pieces(x);
}

// The present value lies well inside its piece.
Expr Draw::in_pieces(const Expr& x) {
  const double v = now(x), below = v - uniform(0.25, 0.6), above = v + uniform(0.25, 0.6);
  const bool up = chance(0.5);
  const Expr edge = x - constant(up ? below : above);  // positive, or negative
  switch (pick(14)) {
    case 0:
    case 1:
    case 2: {
      const std::vector<Function> blends{Function::step, Function::step5, Function::havsin};
      return call(one_of(blends), {x, constant(below), constant(uniform(-0.8, 0.8)), constant(above),
                                   chance(0.5) ? constant(uniform(-0.8, 0.8)) : 0.5 * shaped(displacement())});
    }
    case 3:
    case 4:
      return contact(x, v);
    case 5:
      return call(Function::abs, {edge}) * shaped(x);
    case 6:
      return call(Function::dim, {x, constant(below)});
    case 7: {
      std::vector<Expr> list{shaped(x), constant(-9)};
      if (chance(0.5)) list.push_back(constant(-10));
      return call(Function::maximum, list) + call(Function::minimum, {edge, constant(up ? 0 : 1)});
    }
    case 8: {
      // Half a period beyond a whole number of periods.
      const double period = uniform(0.5, 1.5), whole = pick(3) - 1;
      return call(Function::mod, {x + constant((whole + 0.5) * period - v), constant(period)});
    }
    case 9:
      return call(Function::sign, {x - constant(above), edge});
    case 10:
      return call(Function::choose, {edge, shaped(x), constant(0.3), shaped(displacement())});
    case 11:
      return x * call(Function::aint, {x + constant(1.5 - v)});
    case 12:
      return x * call(Function::anint, {x + constant(-1.2 - v)});
    default: {
      std::vector<Expr> list{x, constant(uniform(0.3, 0.8)), constant(below)};
      list.push_back(constant(uniform(0.05, 0.3)));
      list.push_back(constant(chance(0.5) ? above : v - 0.2));
      list.push_back(constant(uniform(0.1, 0.4)));
      list.push_back(constant(chance(0.5) ? 0.2 : 2.0));
      if (std::fabs(below + 0.2 - v) < 0.1) list.back() = constant(1.5);
      return call(Function::sweep, list);
    }
  }
}

// In contact by a fifth to a half, at a depth that is not near full damping.
Expr Draw::contact(const Expr& x, double v) {
  const double depth = uniform(0.2, 0.5), full = depth * (chance(0.5) ? 0.6 : 2);
  const bool two_sided = chance(0.5), upper = two_sided && chance(0.5);
  std::vector<Expr> list{x, 0.5 * velocity()};
  if (two_sided) {
    list.push_back(constant(upper ? v - depth - 1 : v + depth));
    list.push_back(constant(upper ? v - depth : v + depth + 1));
  } else {
    list.push_back(constant(v + depth));
  }
  for (const double number : {uniform(0.5, 2), uniform(1.2, 2.5), uniform(0, 0.3), full}) {
    list.push_back(constant(number));
  }
  const Expr force = call(two_sided ? Function::bistop : Function::impact, list);
  return std::fabs(now(force)) > 0.02 ? force : shaped(x);
}

}  // namespace dynalin::oracle

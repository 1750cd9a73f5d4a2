#include "elements/forces/evaluated_friction.h"

#include <cmath>
#include <limits>
#include <span>
#include <tuple>

#include "mechanics/pair_motion.h"

namespace dynalin {

namespace {

using D = EvaluatedFriction::D;
using Values = EvaluatedFriction::Values;

// a b, where b may be without slip: then a needs no derivative.
template <class T>
T product(const T& a, const T& b) {
  T r = b * a.value;
  if (b.value == 0.0) return r;
  for (std::size_t k = 0; k < r.partial.size(); ++k) r.partial[k] += a.partial[k] * b.value;
  return r;
}

// Angular velocity of I in the axes of J, ½ Σ a × a′ over the axes of I.
template <class T>
Vec3<T> turning(const RelativeFrame<TimeTaylor<T>>& I) {
  Vec3<T> w{T(0.0), T(0.0), T(0.0)};
  for (const auto* a : {&I.x, &I.y, &I.z}) {
    w += cross(Vec3<T>{a->x.value, a->y.value, a->z.value}, Vec3<T>{a->x.rate, a->y.rate, a->z.rate}) * 0.5;
  }
  return w;
}

template <class T, std::size_t n>
void take(const JointFriction& f, const T& load, const std::array<T, n>& u, const std::array<T, n>& z,
          std::array<double, n> preload, std::array<double, n> lever, std::array<T, 3>& w, std::array<T, 3>& rate) {
  const T pressed = product(load, f.law.coefficient(size_beside_itself(u)));
  const std::array<T, n> s = f.law.direction(u, z);
  for (std::size_t k = 0; k < n; ++k) w[k] = -(product(pressed, s[k]) * lever[k] + s[k] * preload[k]);
  if (!f.law.has_bristles()) return;
  const std::array<T, n> moves = f.law.creep_rate(u, z);
  for (std::size_t k = 0; k < n; ++k) rate[k] = moves[k];
}

template <class T, std::size_t n>
bool takes_rest(const JointFriction& f, std::array<T, n>& u) {
  const double speed = std::sqrt(squared(u).value);
  if (!(speed > 0) || slips(f, speed)) return false;
  for (T& x : u) x.value = 0;
  return true;
}

// Where bristles are in an equilibrium.
Values creep_here(const PlacedFriction& p, const RelativeFrame<TimeTaylor<D>>& I, const Motion& motion) {
  const JointFriction& f = *p.element;
  const FrictionReference before = p.reference(motion);
  const auto now = [](const Vec3<TimeTaylor<D>>& a) { return Vec3<D>{a.x.value, a.y.value, a.z.value}; };
  const Vec3<D> turned = before.rotation(now(I.x), now(I.y), now(I.z));
  const D moved = I.p.z.value - before.displacement();
  const double largest = f.law.largest_creep();
  const auto one = [&](const D& displacement) {
    return Values{creep_at_rest<D, 1>({before.creep(0)}, {displacement}, largest)[0], D(0.0), D(0.0)};
  };
  switch (f.surface) {
    case FrictionSurface::slide:
      return one(moved);
    case FrictionSurface::sleeve: {
      const auto z = creep_at_rest<D, 2>({before.creep(0), before.creep(1)}, {moved, f.pin_radius * turned.z}, largest);
      return {z[0], z[1], D(0.0)};
    }
    case FrictionSurface::ball: {
      const double r = f.ball_radius;
      return creep_at_rest<D, 3>({before.creep(0), before.creep(1), before.creep(2)},
                                 {r * turned.x, r * turned.y, r * turned.z}, largest);
    }
    default:
      return one(f.pin_radius * dot(axis_of(f, I), turned));
  }
}

}  // namespace

FrictionReference PlacedFriction::reference(const Motion& motion) const {
  return FrictionReference(std::span(motion.memory).subspan(static_cast<std::size_t>(first_memory)));
}

EvaluatedFriction EvaluatedFriction::at(const PlacedFriction& p, const PairMotion& pair, const Motion& motion) {
  const JointFriction& f = *p.element;
  EvaluatedFriction out;
  const auto I = path::seeded<std::tuple_size_v<decltype(D::partial)>>(pair.relative);

  // The reaction on I in the axes of J: a function of the pose and linear in the multipliers.
  MarkerWrench reaction;
  p.joint->wrench(motion, p.which, Partials::yes, reaction);
  const Matrix3 R = value(reaction.pair.axes_J), back = transpose(R);
  const auto seen_from_J = [&](const Vector& v, const MarkerPartials& by) {
    const Vector at_J = back * v;
    const Matrix3 on_d = back * by.origin_I * R, on_phi = back * by.axes_I * R;
    Vec3<D> seeded{D(at_J.x), D(at_J.y), D(at_J.z)};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t c = 0; c < 3; ++c) seeded[k].partial[c] = on_d(k, c), seeded[k].partial[3 + c] = on_phi(k, c);
    }
    return seeded;
  };
  Vec3<D> force = seen_from_J(reaction.force.force, reaction.force.force_on_position);
  Vec3<D> torque = seen_from_J(reaction.force.torque, reaction.force.torque_on_position);
  // Along axes that are turned a reaction takes something of every multiplier.
  constexpr double turned = 16 * std::numeric_limits<double>::epsilon();
  const double* known = motion.memory.data() + p.rounding;
  ReactionRounding rounding{known[0], known[1]};
  for (const MarkerWrench::Scalar& s : reaction.scalars) {
    const Vector on_force = back * s.force, on_torque = back * s.torque;
    const double rounded = turned * std::abs(motion.lambda[static_cast<std::size_t>(s.column)]);
    rounding.force += norm(on_force) * rounded, rounding.torque += norm(on_torque) * rounded;
    for (std::size_t k = 0; k < 3; ++k) {
      force[k].partial[first_row_seed + out.row_count] = on_force[k];
      torque[k].partial[first_row_seed + out.row_count] = on_torque[k];
    }
    out.rows[out.row_count++] = s.column;
  }

  const auto creep = [&](std::size_t c) {
    if (p.first_state < 0) return D(0.0);
    return D(motion.state[static_cast<std::size_t>(p.first_state) + c], first_creep_seed + c);
  };
  if (p.first_state >= 0 && is_equilibrium(motion.mode)) out.creep = creep_here(p, I, motion);
  const Vec3<D> axis = axis_of(f, I), w = turning(I);
  const D pressing = load(f, force, torque, axis, I.p.z.value, rounding, out.sizes);
  const auto slips = [&]<std::size_t n>(std::array<D, n> u, std::array<D, n> z, std::array<double, n> preload,
                                        std::array<double, n> lever) {
    out.speed = std::sqrt(squared(u).value);
    take<D, n>(f, pressing, u, z, preload, lever, out.w, out.creep_rate);
    if (motion.mode != AnalysisMode::linear || !takes_rest(f, u)) return;
    Values at_rest_w, at_rest_rate;
    take<D, n>(f, pressing, u, z, preload, lever, at_rest_w, at_rest_rate);
    for (std::size_t k = 0; k < n; ++k)
      out.w[k].partial = at_rest_w[k].partial, out.creep_rate[k].partial = at_rest_rate[k].partial;
  };
  const auto one = [&](const D& u, double preload) {
    slips(std::array{u}, std::array{creep(0)}, std::array{preload}, std::array{1.0});
  };
  switch (f.surface) {
    case FrictionSurface::slide:
      one(I.p.z.rate, f.force_preload);
      break;
    case FrictionSurface::sleeve:
      slips(std::array{I.p.z.rate, f.pin_radius * w.z}, std::array{creep(0), creep(1)},
            std::array{f.force_preload, f.torque_preload}, std::array{1.0, f.pin_radius});
      break;
    case FrictionSurface::ball: {
      const double r = f.ball_radius, T = f.torque_preload;
      slips(std::array{r * w.x, r * w.y, r * w.z}, std::array{creep(0), creep(1), creep(2)}, std::array{T, T, T},
            std::array{1.0, 1.0, 1.0});
      break;
    }
    default:
      one(f.pin_radius * dot(axis, w), f.torque_preload);
  }
  return out;
}

EvaluatedFriction EvaluatedFriction::inactive(const PlacedFriction& p, const Motion& motion) {
  EvaluatedFriction out;
  for (std::size_t c = 0; p.first_state >= 0 && c < p.element->component_count(); ++c)
    out.creep[c] = D(p.reference(motion).creep(c));
  return out;
}

}  // namespace dynalin

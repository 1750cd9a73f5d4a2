#include "elements/forces/friction_kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "elements/families/defined_unknown.h"
#include "elements/families/markers.h"
#include "mechanics/binder.h"
#include "mechanics/pair_blocks.h"

namespace dynalin {

namespace {

// How bristles are listed among the states: after those that the published list names.
constexpr auto bristles = static_cast<StateType>(102);

bool at_rest(const Motion& motion) {
  return motion.mode == AnalysisMode::statics || motion.mode == AnalysisMode::quasi_statics;
}

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

// A slip that is none: what a simulation that has come to rest leaves of it has no direction, and the linear model is
// that of bristles at rest.
constexpr double no_slip = 1e-6;  // of the velocity up to which surfaces stick
template <class T, std::size_t n>
bool takes_rest(const JointFriction& f, std::array<T, n>& u) {
  const double speed = std::sqrt(squared(u).value);
  if (!(speed > 0) || !f.law.has_bristles() || speed > no_slip * f.law.stiction_velocity) return false;
  for (T& x : u) x.value = 0;
  return true;
}

}  // namespace

JointFrictionKernel::JointFrictionKernel(const std::vector<JointFriction>& elements,
                                         const std::vector<ElementLabel>& labels, Layout& layout)
    : labels_(&labels) {
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const JointFriction& f = elements[k];
    const std::size_t n = f.component_count();
    Placed p{&f, &layout.marker(f.i), &layout.marker(f.j), static_cast<std::int32_t>(layout.algebraic.size()), -1, -1,
             -1};
    for (std::size_t c = 0; c < n; ++c) layout.add_algebraic(labels[k], n == 1 ? 0 : static_cast<std::int32_t>(c) + 1);
    if (f.law.has_bristles()) {
      if (f.joint_acts) p.first_state = static_cast<std::int32_t>(layout.states.size());
      // Where there is no friction in equilibria bristles stay as they are.
      for (std::size_t c = 0; f.joint_acts && c < n; ++c)
        layout.add_state({&labels[k], bristles, static_cast<std::int32_t>(c) + 1, 0.0, f.rests_in_statics});
      p.first_memory = static_cast<std::int32_t>(layout.memory.size());
      for (const double x : FrictionReference::of(f.drawn, {})) layout.add_memory(labels[k], "reference", x);
    }
    p.rounding = layout.add_memory(labels[k], "rounding of the force");
    layout.add_memory(labels[k], "rounding of the moment");
    placed_.push_back(p);
  }
}

void JointFrictionKernel::bind(Binder& binder) {
  for (Placed& p : placed_) {
    const Signals::Wrench w = binder.signals().wrench("JOINT", p.element->joint);
    p.joint = w.source, p.which = w.which;
  }
}

JointFrictionKernel::Evaluated JointFrictionKernel::evaluate(const Placed& p, const PairMotion& pair,
                                                             const Motion& motion) const {
  const JointFriction& f = *p.element;
  Evaluated out;
  const auto I = path::seeded<std::tuple_size_v<decltype(D::partial)>>(pair.relative);

  // The reaction on I in the axes of J: a function of the pose and linear in the multipliers.
  MarkerWrench reaction;
  p.joint->wrench(motion, p.which, true, reaction);
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
  if (p.first_state >= 0 && at_rest(motion)) out.creep = creep_here(p, I, motion);
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

// What a value depends on but for creep, take(family, column, partial).
template <class Take>
void JointFrictionKernel::by_motion_and_reaction(const D& value, const Evaluated& at, const PairMotion& pair,
                                                 PartialBy velocity_family, const Layout& layout, const Take& take) {
  // The value as a force along x of J: that direction is at right angles to its own turn, and drops out.
  RelativeWrench carrier;
  carrier.force.x = value.value;
  carrier.depends_on_rate = true;
  for (std::size_t k = 0; k < 6; ++k)
    carrier.on_pose[0][k] = value.partial[k], carrier.on_rate[0][k] = value.partial[6 + k];
  const PairForce spread_out = spread(pair, carrier, true);
  const Vector x = dynalin::value(pair.axes_J).x;
  for_each_block(pair, layout, [&](const PairBlock& b) {
    const BlockPartials on = partials_by(b, spread_out);
    for (std::size_t k = 0; k < b.count; ++k) {
      const std::int32_t column = b.column + static_cast<std::int32_t>(k);
      take(PartialBy::position, column, dot(x, on.force[k]));
      take(velocity_family, column, dot(x, on.force_by_rate[k]));
    }
  });
  for (std::size_t k = 0; k < at.row_count; ++k) take(PartialBy::lambda, at.rows[k], value.partial[first_row_seed + k]);
}

// Subtracts `value` from an equation.
void JointFrictionKernel::add_row(std::int32_t row, const D& value, const Evaluated& at, const Placed& p,
                                  const PairMotion& pair, PartialBy velocity_family, Equations& eq) const {
  eq.add_residual(row, -value.value);
  if (!eq.wants_partials()) return;
  by_motion_and_reaction(value, at, pair, velocity_family, eq.layout(),
                         [&](PartialBy family, std::int32_t column, double by) { eq.add(family, row, column, -by); });
  if (p.first_state < 0) return;
  for (std::size_t k = 0; k < p.element->component_count(); ++k)
    eq.add(PartialBy::state, row, p.first_state + static_cast<std::int32_t>(k), -value.partial[first_creep_seed + k]);
}

void JointFrictionKernel::equations(const Motion& motion, Equations& eq) const {
  MarkerWrench w;
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const Placed& p = placed_[k];
    const JointFriction& f = *p.element;
    eq.begin_element((*labels_)[k]);
    w.clear();
    wrench(motion, k, eq.wants_partials(), w);
    const bool acts = p.joint && !(f.rests_in_statics && at_rest(motion));
    const Evaluated at = acts ? evaluate(p, w.pair, motion) : inactive(p, motion);
    for (std::size_t c = 0; c < f.component_count(); ++c) {
      const std::int32_t row = begin_definition(motion, eq, p.first_algebraic + static_cast<std::int32_t>(c));
      add_row(row, at.w[c], at, p, w.pair, PartialBy::damping, eq);
      if (p.first_state < 0) continue;
      add_creep(p, c, at, w.pair, motion, eq);
    }
    apply(w.pair, w.force, eq);
    for (const MarkerWrench::Scalar& s : w.scalars)
      apply_column(w.pair, s.force, s.torque, true, s.family, s.column, eq);
  }
}

// z′ is what the law says; in equilibria, where z′ = 0, z is.
void JointFrictionKernel::add_creep(const Placed& p, std::size_t component, const Evaluated& at, const PairMotion& pair,
                                    const Motion& motion, Equations& eq) const {
  const std::int32_t z = p.first_state + static_cast<std::int32_t>(component), row = eq.state_row(z);
  const auto k = static_cast<std::size_t>(z);
  const bool rests = at_rest(motion);
  eq.add_residual(row, motion.state_rate[k] + (rests ? motion.state[k] : 0.0));
  eq.add(PartialBy::state_rate, row, z, 1.0);
  eq.add(PartialBy::state, row, z, rests ? 1.0 : 0.0);
  add_row(row, rests ? at.creep[component] : at.creep_rate[component], at, p, pair, PartialBy::velocity, eq);
}

// Exerts nothing, and its bristles stay as they are.
JointFrictionKernel::Evaluated JointFrictionKernel::inactive(const Placed& p, const Motion& motion) {
  Evaluated out;
  for (std::size_t c = 0; p.first_state >= 0 && c < p.element->component_count(); ++c)
    out.creep[c] = D(reference(p, motion).creep(c));
  return out;
}

FrictionReference JointFrictionKernel::reference(const Placed& p, const Motion& motion) {
  return FrictionReference(std::span(motion.memory).subspan(static_cast<std::size_t>(p.first_memory)));
}

JointFrictionKernel::Values JointFrictionKernel::creep_here(const Placed& p, const RelativeFrame<TimeTaylor<D>>& I,
                                                            const Motion& motion) {
  const JointFriction& f = *p.element;
  const FrictionReference before = reference(p, motion);
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

// What a search for an equilibrium passes on its way is no motion.
void JointFrictionKernel::remember(const Motion& motion, Memory& memory) const {
  if (at_rest(motion)) return;
  for (const Placed& p : placed_) {
    if (p.first_memory < 0) continue;
    std::array<double, 3> creep{};
    for (std::size_t c = 0; p.first_state >= 0 && c < p.element->component_count(); ++c)
      creep[c] = motion.state[static_cast<std::size_t>(p.first_state) + c];
    const auto kept = FrictionReference::of(pose_of(pair_motion(motion, *p.I, *p.J).relative), creep);
    std::ranges::copy(kept, memory.begin() + p.first_memory);
  }
}

void JointFrictionKernel::wrench(const Motion& motion, std::size_t k, bool with_partials, MarkerWrench& out) const {
  const Placed& p = placed_[k];
  const JointFriction& f = *p.element;
  out.pair = pair_motion(motion, *p.I, *p.J);
  const Vec3<Dual<6>> axis = axis_of(f, path::seeded<6>(out.pair.relative));
  const Matrix3 R = value(out.pair.axes_J);
  RelativeWrench sum;
  for (std::size_t c = 0; c < f.component_count(); ++c) {
    const std::int32_t a = p.first_algebraic + static_cast<std::int32_t>(c);
    const double w = unknown_at(motion, a);
    Vector force, torque;
    if (f.pushes() && c == 0) {
      force.z = 1;
    } else if (f.surface == FrictionSurface::ball) {
      torque = unit_vectors[c];
    } else {
      torque = {axis.x.value, axis.y.value, axis.z.value};
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t n = 0; n < 6; ++n) sum.on_pose[3 + r][n] += w * axis[r].partial[n];
      }
    }
    sum.force += force * w, sum.torque += torque * w;
    if (with_partials) out.scalars.push_back({PartialBy::algebraic, a, R * force, R * torque});
  }
  out.force = spread(out.pair, sum, with_partials);
  out.force.components = f.surface == FrictionSurface::sleeve ? Components::force_and_torque
                         : f.pushes()                         ? Components::force
                                                              : Components::torque;
}

std::string JointFrictionKernel::domain_violation(const Motion& motion) const {
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const JointFriction& f = *placed_[k].element;
    if (!f.pushes() || f.overlap_growth == 0 || !placed_[k].joint) continue;
    const double left = overlap(f, pair_motion(motion, *placed_[k].I, *placed_[k].J).relative.p.z.value);
    if (left > 0) continue;
    return fmt::format("the parts of {} have slid apart: their overlap is {:g}", (*labels_)[k].full_text(), left);
  }
  return {};
}

void JointFrictionKernel::sticking(const Motion& motion, std::vector<Stiction>& out) const {
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const Placed& p = placed_[k];
    const JointFriction& f = *p.element;
    if (!p.joint || p.first_state < 0) continue;
    const Evaluated at = evaluate(p, pair_motion(motion, *p.I, *p.J), motion);
    Stiction s{k, fmt::format("JOINT/{}", f.joint), p.first_state, {}, f.component_count()};
    double stiffest = 0;
    for (std::size_t c = 0; c < s.directions; ++c) {
      s.stiffness[c] = -at.w[c].partial[first_creep_seed + c] / f.lever(c);
      stiffest = std::max(stiffest, s.stiffness[c]);
    }
    if (f.law.sticks(at.speed) && stiffest > 0) out.push_back(s);
  }
}

void JointFrictionKernel::exhausted(const Motion& motion, std::vector<std::string>& sentences) const {
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const Placed& p = placed_[k];
    const JointFriction& f = *p.element;
    if (!p.joint || p.first_state < 0 || f.rests_in_statics) continue;
    const Evaluated at = evaluate(p, pair_motion(motion, *p.I, *p.J), motion);
    std::array<double, most_components> bent{}, borne{}, tried{};
    for (std::size_t c = 0; c < f.component_count(); ++c) {
      bent[c] = at.creep[c].value, borne[c] = at.w[c].value;
      tried[c] = motion.state[static_cast<std::size_t>(p.first_state) + c];
    }
    const double largest = f.law.largest_creep(), size_tried = std::sqrt(squared(tried));
    if (!(std::sqrt(squared(bent)) > elastic_share * largest)) continue;
    // Bristles that bear the more the farther they bend may have been tried farther than they go.
    if (f.law.formulation == FrictionFormulation::lugre && size_tried > largest) {
      for (double& w : borne) w *= largest / size_tried;
    }
    std::string size = fmt::format("{:.5g}", std::sqrt(squared(borne)));
    if (f.surface == FrictionSurface::sleeve)
      size = fmt::format("{:.5g} along and {:.5g} about the axis", std::abs(borne[0]), std::abs(borne[1]));
    sentences.push_back(
        fmt::format("{} bears {}, as much as JOINT/{} can bear by friction there, and slides under what is left",
                    (*labels_)[k].full_text(), size, f.joint));
  }
}

void JointFrictionKernel::vanishing(const Motion& motion, const Layout& layout, std::vector<VanishingSize>& out) const {
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const Placed& p = placed_[k];
    if (!p.joint || (p.element->rests_in_statics && at_rest(motion))) continue;
    const PairMotion pair = pair_motion(motion, *p.I, *p.J);
    const Evaluated at = evaluate(p, pair, motion);
    for (const Sizes::Vanishing& none : at.sizes.vanishing()) {
      VanishingSize size;
      for (std::size_t c = 0; c < p.element->component_count(); ++c) {
        if (at.w[c].partial[none.seed] != 0) size.algebraic.push_back(p.first_algebraic + static_cast<std::int32_t>(c));
      }
      if (size.algebraic.empty()) continue;
      for (std::size_t c = 0; c < none.count; ++c) {
        std::vector<VanishingSize::Partial>& component = size.components.emplace_back();
        by_motion_and_reaction(none.components[c], at, pair, PartialBy::damping, layout,
                               [&](PartialBy family, std::int32_t column, double by) {
                                 if (by != 0) component.push_back({family, column, by});
                               });
      }
      size.reason = fmt::format(
          "{}: a force or moment that JOINT/{} bears across its surfaces is zero while they "
          "slip, and friction by its size has no derivative there",
          (*labels_)[k].full_text(), p.element->joint);
      out.push_back(std::move(size));
    }
  }
}

void JointFrictionKernel::take_rounding(const Motion& motion, std::span<const double> of_multipliers,
                                        Memory& memory) const {
  for (const Placed& p : placed_) {
    double* const known = memory.data() + p.rounding;
    known[0] = known[1] = 0;
    if (!p.joint) continue;
    MarkerWrench reaction;
    p.joint->wrench(motion, p.which, true, reaction);
    for (const MarkerWrench::Scalar& s : reaction.scalars) {
      const double rounded = of_multipliers[static_cast<std::size_t>(s.column)];
      known[0] += norm(s.force) * rounded, known[1] += norm(s.torque) * rounded;
    }
  }
}

void JointFrictionKernel::surfaces(std::vector<BristlesBetween>& out) const {
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const JointFriction& f = *placed_[k].element;
    out.push_back({&(*labels_)[k], f.i, f.j, f.is_along_common_z()});
  }
}

}  // namespace dynalin

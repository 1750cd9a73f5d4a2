#include "elements/forces/friction_kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/families/defined_unknown.h"
#include "elements/families/markers.h"
#include "mechanics/binder.h"
#include "mechanics/pair_blocks.h"

namespace dynalin {

namespace {

// How bristles are listed among the states: after those that the published list names.
constexpr auto bristles = static_cast<StateType>(102);

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
  const PairForce spread_out = spread(pair, carrier, Partials::yes);
  const Vector x = dynalin::value(pair.axes_J).x;
  for_each_block(pair, layout, [&](const PairBlock& b) {
    const BlockPartials on = partials_by(b, spread_out);
    for (std::size_t k = 0; k < b.count; ++k) {
      const std::int32_t column = b.column + static_cast<std::int32_t>(k);
      take(PartialBy::position, column, dot(x, on.force[k]));
      take(velocity_family, column, dot(x, on.force_by_rate[k]));
    }
  });
  for (std::size_t k = 0; k < at.row_count; ++k)
    take(PartialBy::lambda, at.rows[k], value.partial[Evaluated::first_row_seed + k]);
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
    eq.add(PartialBy::state, row, p.first_state + static_cast<std::int32_t>(k),
           -value.partial[Evaluated::first_creep_seed + k]);
}

void JointFrictionKernel::equations(const Motion& motion, Equations& eq) const {
  MarkerWrench w;
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const Placed& p = placed_[k];
    const JointFriction& f = *p.element;
    eq.begin_element((*labels_)[k]);
    w.clear();
    wrench(motion, k, eq.wanted_partials(), w);
    const bool acts = p.joint && !(f.rests_in_statics && is_equilibrium(motion.mode));
    const Evaluated at = acts ? Evaluated::at(p, w.pair, motion) : Evaluated::inactive(p, motion);
    for (std::size_t c = 0; c < f.component_count(); ++c) {
      const std::int32_t row = begin_definition(motion, eq, p.first_algebraic + static_cast<std::int32_t>(c));
      add_row(row, at.w[c], at, p, w.pair, PartialBy::damping, eq);
      if (p.first_state < 0) continue;
      add_creep(p, c, at, w.pair, motion, eq);
    }
    apply(w.pair, w.force, eq);
    for (const MarkerWrench::Scalar& s : w.scalars)
      apply_column(w.pair, s.force, s.torque, Reaction::at_I, s.family, s.column, eq);
  }
}

// z′ is what the law says; in equilibria, where z′ = 0, z is.
void JointFrictionKernel::add_creep(const Placed& p, std::size_t component, const Evaluated& at, const PairMotion& pair,
                                    const Motion& motion, Equations& eq) const {
  const std::int32_t z = p.first_state + static_cast<std::int32_t>(component), row = eq.state_row(z);
  const auto k = static_cast<std::size_t>(z);
  const bool rests = is_equilibrium(motion.mode);
  eq.add_residual(row, motion.state_rate[k] + (rests ? motion.state[k] : 0.0));
  eq.add(PartialBy::state_rate, row, z, 1.0);
  eq.add(PartialBy::state, row, z, rests ? 1.0 : 0.0);
  add_row(row, rests ? at.creep[component] : at.creep_rate[component], at, p, pair, PartialBy::velocity, eq);
}

// What a search for an equilibrium passes on its way is no motion.
void JointFrictionKernel::remember(const Motion& motion, Memory& memory) const {
  if (is_equilibrium(motion.mode)) return;
  for (const Placed& p : placed_) {
    if (p.first_memory < 0) continue;
    std::array<double, 3> creep{};
    for (std::size_t c = 0; p.first_state >= 0 && c < p.element->component_count(); ++c)
      creep[c] = motion.state[static_cast<std::size_t>(p.first_state) + c];
    const auto kept = FrictionReference::of(pose_of(pair_motion(motion, *p.I, *p.J).relative), creep);
    std::ranges::copy(kept, memory.begin() + p.first_memory);
  }
}

void JointFrictionKernel::wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const {
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
    if (wanted == Partials::yes) out.scalars.push_back({PartialBy::algebraic, a, R * force, R * torque});
  }
  out.force = spread(out.pair, sum, wanted);
  out.force.components = f.surface == FrictionSurface::sleeve ? Components::force_and_torque
                         : f.pushes()                         ? Components::force
                                                              : Components::torque;
}

std::string JointFrictionKernel::domain_violation(const Motion& motion) const {
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const JointFriction& f = *placed_[k].element;
    if (!f.pushes() || !f.of_bending || f.overlap_growth == 0 || !placed_[k].joint) continue;
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
    const Evaluated at = Evaluated::at(p, pair_motion(motion, *p.I, *p.J), motion);
    Stiction s{k, fmt::format("JOINT/{}", f.joint), p.first_state, {}, f.component_count()};
    double stiffest = 0;
    for (std::size_t c = 0; c < s.directions; ++c) {
      s.stiffness[c] = -at.w[c].partial[Evaluated::first_creep_seed + c] / f.lever(c);
      stiffest = std::max(stiffest, s.stiffness[c]);
    }
    if (f.law.sticks(at.speed) && stiffest > 0) out.push_back(s);
  }
}

void JointFrictionKernel::exhausted(const Motion& motion, std::vector<std::string>& sentences) const {
  for (std::size_t k = 0; k < placed_.size(); ++k) {
    const Placed& p = placed_[k];
    const JointFriction& f = *p.element;
    if (!p.joint) continue;
    if (f.rests_in_statics || p.first_state < 0) {
      sentences.push_back(fmt::format("{} of JOINT/{} {}", (*labels_)[k].full_text(), f.joint,
                                      f.rests_in_statics ? "is left out of statics by INACTIVE=STATIC"
                                                         : "has no bristles, and holds nothing at rest"));
      continue;
    }
    const Evaluated at = Evaluated::at(p, pair_motion(motion, *p.I, *p.J), motion);
    std::array<double, Evaluated::most_components> bent{}, borne{}, tried{};
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
    if (!p.joint || (p.element->rests_in_statics && is_equilibrium(motion.mode))) continue;
    const PairMotion pair = pair_motion(motion, *p.I, *p.J);
    const Evaluated at = Evaluated::at(p, pair, motion);
    for (const Evaluated::Sizes::Vanishing& none : at.sizes.vanishing()) {
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
          "{}: a force or moment that JOINT/{} bears across its surfaces is zero while {}, and friction by its size "
          "has "
          "no derivative there",
          (*labels_)[k].full_text(), p.element->joint,
          slips(*p.element, at.speed) ? "they slip" : "bristles between them are bent");
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
    p.joint->wrench(motion, p.which, Partials::yes, reaction);
    for (const MarkerWrench::Scalar& s : reaction.scalars) {
      const double rounded = of_multipliers[static_cast<std::size_t>(s.column)];
      known[0] += norm(s.force) * rounded, known[1] += norm(s.torque) * rounded;
    }
  }
}

}  // namespace dynalin

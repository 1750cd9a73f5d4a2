#include "elements/families/function_force.h"

#include "elements/families/drawn_axes.h"

namespace dynalin {

FunctionForceKernel::FunctionForceKernel(std::vector<FunctionForce> elements, Layout& layout) {
  forces_.reserve(elements.size());
  for (FunctionForce& e : elements) {
    const MarkerPlace *I = &layout.marker(e.i), *J = &layout.marker(e.j);
    const DefinedUnknown magnitude(layout.add_algebraic(*e.label), e.magnitude);
    forces_.push_back({std::move(e), I, J, magnitude});
  }
}

void FunctionForceKernel::bind(Binder& binder) {
  for (Force& f : forces_) f.magnitude.bind(binder);
}

std::optional<FunctionForceKernel::Meeting> FunctionForceKernel::meeting(const Force& f, const PairMotion& pair,
                                                                         const Motion& motion,
                                                                         ExpressionScratch& scratch, Partials wanted) {
  if (f.element.direction != Direction::along_line || !markers_meet(pair)) return std::nullopt;
  const AtMeeting e = f.magnitude.where_they_meet(motion, scratch, *f.I, *f.J);
  const PairForce nowhere = without_direction(wanted);
  if (e.is_multiple_of_distance()) return Meeting{e, around_origin({0.0, e.by_distance, 0.0}, wanted), PairForce{}};
  if (e.value != 0.0) return Meeting{e, nowhere, nowhere};
  // Nothing, but what it varies with acts along a line that is not there. By a gradient of no value it has none either.
  PairForce none = nowhere;
  none.force = {};
  if (e.others == AtMeeting::Others::defined) none = around_origin({0.0, 0.0, 0.0}, wanted);
  return Meeting{e, none, nowhere};
}

PairForce FunctionForceKernel::force_of(const Force& f, const PairMotion& pair, double magnitude, Partials wanted) {
  if (f.element.direction == Direction::along_line) {
    return along_line(pair, {magnitude, 0.0, 0.0}, wanted);
  }
  const bool pushes = f.element.direction == Direction::along_z;
  RelativeWrench w;
  (pushes ? w.force : w.torque).z = magnitude;
  PairForce force = spread(pair, w, wanted);
  force.components = pushes ? Components::force : Components::torque;
  if (f.element.action_only) force.reaction = Reaction::none;
  return force;
}

void FunctionForceKernel::equations(const Motion& motion, Equations& eq) const {
  for (const Force& f : eq.share(forces_)) {
    eq.begin_element(*f.element.label);
    const PairMotion pair = pair_motion(motion, *f.I, *f.J);
    const auto met = meeting(f, pair, motion, eq.scratch, eq.wanted_partials());
    if (met && met->magnitude.is_multiple_of_distance()) {
      f.magnitude.add_equation_of_zero(motion, eq);
    } else {
      f.magnitude.add_equation(motion, eq);
    }
    const PairForce force = met ? met->force : force_of(f, pair, f.magnitude.at(motion), eq.wanted_partials());
    apply(pair, force, eq);
    if (!eq.wants(PartialBy::algebraic)) continue;
    const PairForce one = met ? met->by_magnitude : force_of(f, pair, 1.0, Partials::no);
    apply_column(pair, one.force, one.torque, force.reaction, PartialBy::algebraic, f.magnitude.column(), eq);
  }
}

void FunctionForceKernel::wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const {
  const Force& f = forces_[k];
  out.pair = pair_motion(motion, *f.I, *f.J);
  ExpressionScratch scratch;
  const auto met = meeting(f, out.pair, motion, scratch, wanted);
  out.force = met ? met->force : force_of(f, out.pair, f.magnitude.at(motion), wanted);
  if (wanted == Partials::no) return;
  const PairForce one = met ? met->by_magnitude : force_of(f, out.pair, 1.0, Partials::no);
  out.scalars.push_back({PartialBy::algebraic, f.magnitude.column(), one.force, one.torque});
}

void FunctionForceKernel::undefined_values(const Motion& motion, UndefinedValues& undefined_values) const {
  for (const Force& f : forces_) {
    ExpressionScratch scratch;
    if (const auto met = meeting(f, pair_motion(motion, *f.I, *f.J), motion, scratch, Partials::no)) {
      // A multiple of the distance has no corner, though the distance has.
      if (met->magnitude.is_multiple_of_distance()) continue;
      undefined_values.add(
          UndefinedValue{f.element.label, text_without_direction(*f.element.label), met->magnitude.value != 0.0});
    }
    f.magnitude.find_undefined(motion, *f.element.label, undefined_values);
  }
}

}  // namespace dynalin

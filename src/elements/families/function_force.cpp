#include "elements/families/function_force.h"

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
    f.magnitude.add_equation(motion, eq);
    const PairMotion pair = pair_motion(motion, *f.I, *f.J);
    const PairForce force = force_of(f, pair, f.magnitude.at(motion), eq.wanted_partials());
    apply(pair, force, eq);
    if (!eq.wants(PartialBy::algebraic)) continue;
    const PairForce one = force_of(f, pair, 1.0, Partials::no);
    apply_column(pair, one.force, one.torque, force.reaction, PartialBy::algebraic, f.magnitude.column(), eq);
  }
}

void FunctionForceKernel::wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const {
  const Force& f = forces_[k];
  out.pair = pair_motion(motion, *f.I, *f.J);
  out.force = force_of(f, out.pair, f.magnitude.at(motion), wanted);
  if (wanted == Partials::no) return;
  const PairForce one = force_of(f, out.pair, 1.0, Partials::no);
  out.scalars.push_back({PartialBy::algebraic, f.magnitude.column(), one.force, one.torque});
}

void FunctionForceKernel::undefined_values(const Motion& motion, UndefinedValues& undefined_values) const {
  for (const Force& f : forces_) {
    if (f.element.direction == Direction::along_line && norm(motion.point(*f.I) - motion.point(*f.J)) == 0.0) {
      undefined_values.add(UndefinedValue{f.element.label, "the markers of " + f.element.label->full_text() +
                                                               " coincide, its line of action has no direction"});
    }
    f.magnitude.find_undefined(motion, *f.element.label, undefined_values);
  }
}

}  // namespace dynalin

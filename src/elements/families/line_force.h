// One scalar law along the line between two markers, or about the z axis of J.
//
// line_force: a member gives `S along_line(const TimeTaylor<S>& d)`, the force as a law of the distance and its
// rate; positive pushes I away from J, says with `bool needs_direction()` whether it is anything but a multiple of the
// distance, and with `double stated_force()` what of it comes of neither. axis_torque: a member gives `S
// about_axis(const S& angle, const S& rate)`, the torque on I about z_J as a law of AZ(I,J), whole turns counted, and
// WZ(I,J,J), and says with `bool reads_angle()` whether the angle has a factor in it: AZ does not exist everywhere, and
// is not evaluated if it has none.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "elements/families/drawn_axes.h"
#include "elements/families/joint.h"
#include "elements/families/markers.h"
#include "elements/families/read_displacement.h"
#include "mechanics/kernel.h"
#include "mechanics/noted_laws.h"
#include "mechanics/path.h"
#include "mechanics/wrench_source.h"
#include "model/schema.h"

namespace dynalin {

template <class E>
class LineForceKernel final : public Kernel, public WrenchSource {
 public:
  LineForceKernel(const std::vector<E>& elements, const std::vector<ElementLabel>& labels, Layout& layout)
      : labels_(&labels) {
    for (const E& e : elements) forces_.push_back({e, layout.marker(e.i), layout.marker(e.j)});
  }

  std::size_t shares() const override { return shares_of(forces_.size()); }
  void equations(const Motion& motion, Equations& eq) const override {
    for (const std::size_t k : eq.share(forces_.size())) {
      const Force& f = forces_[k];
      const PairMotion pair = pair_motion(motion, f.I, f.J);
      eq.begin_element((*labels_)[k]);
      if (ElementTrace* trace = eq.noted()) note(f, pair, eq.layout(), *trace);
      apply(pair, force_of(f, pair, eq.wanted_partials()), eq);
    }
  }

  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return forces_[k].element.i; }
  MarkerId marker_J(std::size_t k) const override { return forces_[k].element.j; }
  void wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const override {
    out.pair = pair_motion(motion, forces_[k].I, forces_[k].J);
    out.force = force_of(forces_[k], out.pair, wanted);
  }
  void undefined_values(const Motion& motion, UndefinedValues& undefined_values) const override {
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      const PairMotion pair = pair_motion(motion, forces_[k].I, forces_[k].J);
      if (!markers_meet(pair)) continue;
      const LineMagnitude F = where_they_meet(forces_[k], pair);
      if (F.value == 0.0 && F.on_rate == 0.0) continue;
      undefined_values.add(UndefinedValue{&(*labels_)[k], text_without_direction((*labels_)[k]), F.value != 0.0});
    }
  }

 private:
  struct Force {
    E element;
    MarkerPlace I, J;
  };
  static LineMagnitude law(const Force& f, double distance, double rate) {
    const Dual<2> F = f.element.along_line(
        TimeTaylor<Dual<2>>{Dual<2>(distance, 0), Dual<2>(rate, 1), Dual<2>(detail::missing(0.0))});
    return {F.value, F.partial[0], F.partial[1]};
  }
  // They part as fast as they move.
  static LineMagnitude where_they_meet(const Force& f, const PairMotion& pair) {
    return law(f, 0.0, norm(rate(pair.delta)));
  }
  static PairForce force_of(const Force& f, const PairMotion& pair, Partials wanted) {
    if (markers_meet(pair)) {
      const LineMagnitude F = where_they_meet(f, pair);
      return F.value == 0.0 ? around_origin(F, wanted) : without_direction(wanted);
    }
    const Taylor d = norm(pair.delta);
    return along_line(pair, law(f, d.value, d.rate), wanted);
  }
  static void note(const Force& f, const PairMotion& pair, const Layout& layout, ElementTrace& trace) {
    if (markers_meet(pair)) return;
    const Taylor d = norm(pair.delta);
    const LineMagnitude F = law(f, d.value, d.rate);
    const double rounding = std::abs(F.on_distance) * (d.value + lengths_of_places(pair));
    note_line(pair, F, rounding_of_force(rounding, f.element.stated_force()), layout, trace);
  }
  std::vector<Force> forces_;
  const std::vector<ElementLabel>* labels_;
};

template <class E>
class AxisTorqueKernel final : public Kernel, public WrenchSource {
 public:
  AxisTorqueKernel(const std::vector<E>& elements, const std::vector<ElementLabel>& labels, Layout& layout)
      : labels_(&labels) {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const E& e = elements[k];
      torques_.push_back({e, layout.marker(e.i), layout.marker(e.j),
                          CountedAngles(layout, e.i, e.j, {false, false, e.reads_angle()})});
    }
  }

  std::size_t shares() const override { return shares_of(torques_.size()); }
  void equations(const Motion& motion, Equations& eq) const override {
    for (const std::size_t k : eq.share(torques_.size())) {
      const Torque& t = torques_[k];
      const PairMotion pair = pair_motion(motion, t.I, t.J);
      eq.begin_element((*labels_)[k]);
      const RelativeWrench law = law_of(t, pair, motion);
      if (ElementTrace* trace = eq.noted()) note(t, pair, law, eq.layout(), *trace);
      apply(pair, torque_of(pair, law, eq.wanted_partials()), eq);
    }
  }

  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return torques_[k].element.i; }
  MarkerId marker_J(std::size_t k) const override { return torques_[k].element.j; }
  void wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const override {
    out.pair = pair_motion(motion, torques_[k].I, torques_[k].J);
    out.force = torque_of(out.pair, law_of(torques_[k], out.pair, motion), wanted);
  }
  void undefined_values(const Motion& motion, UndefinedValues& undefined) const override {
    for (std::size_t k = 0; k < torques_.size(); ++k) {
      const Torque& t = torques_[k];
      if (auto angle = undefined_angle((*labels_)[k], t.angles.read(), pair_motion(motion, t.I, t.J)))
        undefined.add(std::move(*angle));
    }
  }

 private:
  struct Torque {
    E element;
    MarkerPlace I, J;
    CountedAngles angles;
  };
  static RelativeWrench law_of(const Torque& t, const PairMotion& pair, const Motion& motion) {
    const auto I = path::seeded<12>(pair.relative);
    Dual<12> angle(0.0);
    if (constexpr std::size_t AZ = 2; t.angles.read()[AZ]) {
      angle = joint_rotation(I).value;
      angle.value = unwrapped(angle.value, t.angles.total(AZ, motion));
    }
    // z component of the relative angular velocity, ½ Σ a × a′ over the axes of I seen from J.
    const auto about_z = [](const auto& a) { return a.x.value * a.y.rate - a.y.value * a.x.rate; };
    const Dual<12> rate = (about_z(I.x) + about_z(I.y) + about_z(I.z)) * 0.5;
    const Dual<12> torque = t.element.about_axis(angle, rate);
    RelativeWrench w;
    w.torque.z = torque.value;
    w.depends_on_rate = true;
    for (std::size_t k = 0; k < 6; ++k) {
      w.on_pose[5][k] = torque.partial[k];
      w.on_rate[5][k] = torque.partial[6 + k];
    }
    return w;
  }
  static PairForce torque_of(const PairMotion& pair, const RelativeWrench& w, Partials wanted) {
    PairForce force = spread(pair, w, wanted);
    force.components = Components::torque;
    return force;
  }
  static void note(const Torque& t, const PairMotion& pair, const RelativeWrench& w, const Layout& layout,
                   ElementTrace& trace) {
    const double stated = t.element.stated_torque();
    double stiffness = 0;
    for (std::size_t k = 3; k < 6; ++k) stiffness = std::max(stiffness, std::abs(w.on_pose[5][k]));
    // By as far as it is turned, and by a turn.
    std::array<double, 6> rounding{};
    rounding[5] = rounding_of_force(std::abs(w.torque.z - stated) + 2 * std::numbers::pi * stiffness, stated);
    note_law(pair, w, rounding, layout, trace);
  }
  std::vector<Torque> torques_;
  const std::vector<ElementLabel>* labels_;
};

template <class E, template <class> class KernelOf>
class TwoMarkerForceSet final : public TypedSet<E> {
 public:
  using TypedSet<E>::TypedSet;
  void read(std::size_t k, ElementReader& reader) override { read_arguments(this->elements[k], reader); }
  void finish(Model& model, Diagnostics& diagnostics) override {
    constexpr bool turns = E::acts_on_rotation;
    for (std::size_t k = 0; k < this->elements.size(); ++k) {
      const E& e = this->elements[k];
      if (!check_pair(model, this->labels[k], e.i, e.j, {.rotation_of_I = turns, .rotation_of_J = turns}, diagnostics))
        continue;
      if constexpr (!turns) {
        if (e.needs_direction()) warn_of_missing_line(model, this->labels[k], e.i, e.j, diagnostics);
      }
      if (turns) warn_of_skew_axes(model, this->labels[k], e.i, e.j, diagnostics);
    }
  }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<KernelOf<E>>(this->elements, this->labels, layout);
  }
};

template <class E, template <class> class KernelOf>
constexpr Kind two_marker_force() {
  return Kind{E::keyword,
              E::variant,
              E::summary,
              Kind::Role::element,
              detail::argument_infos<E>,
              [](const Kind& kind) -> std::unique_ptr<ElementSet> {
                return std::make_unique<TwoMarkerForceSet<E, KernelOf>>(kind);
              },
              Kind::EnergyRows::one}
      .deactivatable();
}
template <class E>
constexpr Kind line_force() {
  return two_marker_force<E, LineForceKernel>();
}
template <class E>
constexpr Kind axis_torque() {
  return two_marker_force<E, AxisTorqueKernel>();
}

}  // namespace dynalin

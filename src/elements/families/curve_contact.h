// Constraints with curve parameters as coordinates: PTCV, CVCV, PLCV and AXCV.
//
// Marker I and marker J carry what touches; the parameters u of the points of contact are coordinates of the system
// beside those of the bodies, without inertia. A member of the family gives
//
//     static constexpr StateType state_type;                             // of the parameters
//     static constexpr std::array<std::string_view, m> parameter_names;
//     static constexpr std::array<StartArguments, m> starts;             // arguments that state where and how fast
//     static constexpr std::array<std::string_view, n> row_names;
//     std::array<std::shared_ptr<const ParametricCurve>, m> curves;      // which each parameter runs along
//     template <class T> std::array<T, n> rows(const RelativeFrame<T>& I, const std::array<T, m>& u) const;
//     template <class T> Vec3<T> point(const RelativeFrame<T>& I, const std::array<T, m>& u) const;
//                                                                        // of contact, from the origin of I in J's
//                                                                        axes
//     std::array<double, m> nearest(const RelativeFrame<double>& I) const;  // parameters, where nothing states them
//
// Rows at all levels, reactions and their variation follow: with the row gradients along displacement and rotation of I
// as seen from J and along u as seeds 0–5 and 6 on, the balance of a parameter is Σ λ_r ∂Φ_r/∂u = 0, so a reaction does
// no work along a curve. It is reported at the point of contact. A member may say where its contact is undetermined,
//
//     std::string undetermined(const RelativeFrame<double>& I, const std::array<double, m>& u) const;
//
// in words that follow the name of the element, empty where it is not.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "elements/families/curve.h"
#include "elements/families/markers.h"
#include "mechanics/event_source.h"
#include "mechanics/follower_source.h"
#include "mechanics/kernel.h"
#include "mechanics/path.h"
#include "mechanics/start_source.h"
#include "mechanics/undefined_value.h"
#include "mechanics/wrench_source.h"
#include "model/model.h"
#include "model/schema.h"

namespace dynalin {

// One parameter at the start.
struct ContactStart {
  double parameter = 0;            // where the search begins
  bool held = false;               // the contact starts there, whatever else has to move
  std::optional<double> velocity;  // of the point of contact along the curve, towards growing u [length/time]
};

template <class E>
struct CurveContact {
  static constexpr std::size_t m = E::parameter_names.size();
  E element;
  MarkerId i, j;              // the frames
  MarkerId touch_I, touch_J;  // the markers at the point of contact that force functions name
  // The floating markers there, the markers that carry the curves they run along, and their parameters.
  struct Floating {
    MarkerId marker, carrier;
    std::size_t parameter = 0;
  };
  std::vector<Floating> floating;
  std::array<ContactStart, m> start;
};

// The parameter next to a stated point, given in the axes of marker `axes` (not valid: those of the curve's own
// marker). Both markers are on one body.
double stated_parameter(const Model&, const Curve&, const Vector& point, MarkerId own, MarkerId axes);
// Reports a marker that is not floating or not on the body of the curve's marker, and a marker `axes` that is not
// either.
bool check_contact_marker(Model&, const ElementLabel&, MarkerId floating, std::string_view argument, MarkerId own,
                          Diagnostics&);
// Reports axes of a point at the start that is not stated.
void check_start_point(ElementReader&, bool has_axes, bool has_point, std::string_view axes, std::string_view point);
bool check_start_axes(const Model&, const ElementLabel&, MarkerId axes, std::string_view argument, MarkerId own,
                      Diagnostics&);

template <class E>
class CurveContactKernel final : public Kernel,
                                 public WrenchSource,
                                 public StartSource,
                                 public SwitchSource,
                                 public FollowerSource {
 public:
  static constexpr std::size_t n = E::row_names.size(), m = E::parameter_names.size(), seeds = 6 + m;

  CurveContactKernel(const std::vector<CurveContact<E>>& contacts, const std::vector<ElementLabel>& labels,
                     Layout& layout)
      : labels_(&labels) {
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const CurveContact<E>& c = contacts[k];
      std::vector<ExtraCoordinate> coordinates;
      for (std::size_t a = 0; a < m; ++a) {
        coordinates.push_back({std::string(E::parameter_names[a]), c.start[a].parameter,
                               c.element.curves[a]->least_speed(), largest_step * c.element.curves[a]->range()});
      }
      Placed p{c,
               layout.marker(c.i),
               layout.marker(c.j),
               layout.add_extra(labels[k], {E::state_type, ExtraRole::follower}, std::move(coordinates)),
               0,
               0};
      p.first_extra = layout.extra_index(p.first_coordinate);
      for (const auto& floating : c.floating) {
        layout.curve_points.push_back({floating.marker, floating.carrier, c.element.curves[floating.parameter],
                                       coordinate(p, floating.parameter)});
      }
      for (std::size_t r = 0; r < n; ++r) {
        const std::int32_t row = layout.add_row(labels[k], E::row_names[r]);
        if (r == 0) p.first_row = row;
      }
      for (std::size_t a = 0; a < m; ++a) {
        const ContactStart& s = c.start[a];
        if (!s.held && !s.velocity) continue;
        const auto place = s.held ? std::optional(s.parameter) : std::nullopt;
        starts_.push_back({&labels[k], "contact point", place, s.velocity, E::starts[a]});
        start_places_.push_back({contacts_.size(), a});
      }
      followers_.push_back(
          {p.first_coordinate, static_cast<std::int32_t>(m), p.first_row, static_cast<std::int32_t>(n)});
      contacts_.push_back(std::move(p));
    }
  }

  std::span<const Follower> followers() const override { return followers_; }
  void find(std::size_t k, const Motion& motion, std::span<double> values) const override {
    const Placed& p = contacts_[k];
    const auto u = p.contact.element.nearest(pose_of(pair_motion(motion, p.I, p.J).relative));
    std::copy(u.begin(), u.end(), values.begin());
  }

  void constraints(const Motion& motion, ConstraintRows& rows) const override {
    using Parameter = TimeTaylor<Dual<seeds>>;
    for (const Placed& p : contacts_) {
      const PairMotion pair = pair_motion(motion, p.I, p.J);
      std::array<Parameter, m> u;
      for (std::size_t a = 0; a < m; ++a) {
        u[a] = path::constant<seeds>(along_motion(p, a, motion));
        u[a].value.partial[6 + a] = 1.0;
      }
      const auto phi = p.contact.element.rows(path::seeded<seeds>(pair.relative), u);
      for (std::size_t r = 0; r < n; ++r) {
        const std::int32_t row = p.first_row + static_cast<std::int32_t>(r);
        const auto partial = [&](std::size_t k) {
          return Taylor(phi[r].value.partial[k], phi[r].rate.partial[k], phi[r].acceleration.partial[k]);
        };
        rows.set(row, {phi[r].value.value, phi[r].rate.value, phi[r].acceleration.value});
        add_gradient(row, pair, {partial(0), partial(1), partial(2)}, {partial(3), partial(4), partial(5)}, rows);
        for (std::size_t a = 0; a < m; ++a) rows.add_coordinate(row, coordinate(p, a), partial(6 + a));
      }
    }
  }

  // The reactions themselves are added from the constraint rows; here only their variation.
  void equations(const Motion& motion, Equations& eq) const override {
    if (!eq.wants(PartialBy::position)) return;
    for (const Placed& p : contacts_) {
      eq.begin_constraint(p.first_row, static_cast<std::int32_t>(n));
      const PairMotion pair = pair_motion(motion, p.I, p.J);
      const Nested work = reaction_work(p, pair, motion);
      const ReactionWrench at_I = reaction_at_I(work);
      apply_partials(pair, spread(pair, relative_wrench(at_I), Partials::yes), eq);
      const Matrix3 R = value(pair.axes_J);
      for (std::size_t a = 0; a < m; ++a) {
        apply_column(pair, R * slope(at_I.force, 6 + a), R * slope(at_I.torque, 6 + a), Reaction::at_I,
                     PartialBy::position, coordinate(p, a), eq);
        const Dual<seeds>& of_parameter = work.partial[6 + a];
        const auto g = [&](std::size_t k) { return -of_parameter.partial[k]; };
        add_partials(coordinate(p, a), pair, {g(0), g(1), g(2)}, {g(3), g(4), g(5)}, PartialBy::position, eq);
        for (std::size_t b = 0; b < m; ++b) eq.add(PartialBy::position, coordinate(p, a), coordinate(p, b), g(6 + b));
      }
    }
  }

  const StartSource* starts() const override { return this; }
  std::span<const StartCondition> start_conditions() const override { return starts_; }
  // Arc from the point asked for, its rate exact where it is met.
  void start_rows(const Motion& motion, std::int32_t first, ConstraintRows& rows) const override {
    for (std::size_t k = 0; k < starts_.size(); ++k) {
      const auto [at, a] = start_places_[k];
      const Placed& p = contacts_[at];
      const ParametricCurve& drawn = *p.contact.element.curves[a];
      const Taylor u = along_motion(p, a, motion);
      const Taylor speed = norm(drawn.at(u, 1));
      const double away = drawn.difference(u.value, p.contact.start[a].parameter);
      const std::int32_t row = first + static_cast<std::int32_t>(k);
      rows.set(row, {speed.value * away, speed.value * u.rate, speed.rate * u.rate + speed.value * u.acceleration});
      rows.add_coordinate(row, coordinate(p, a), speed);
    }
  }

  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return contacts_[k].contact.touch_I; }
  MarkerId marker_J(std::size_t k) const override { return contacts_[k].contact.touch_J; }
  void wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const override {
    const Placed& p = contacts_[k];
    out.pair = pair_motion(motion, p.I, p.J);
    const RelativeFrame<Nested> I = path::nested<seeds>(out.pair.relative);
    const std::array<Nested, m> u = nested_parameters(p, motion);
    const std::array<Nested, n> rows = p.contact.element.rows(I, u);
    const Vec3<Nested> varied_point = p.contact.element.point(I, u);
    const Vec3<Dual<seeds>> point{varied_point.x.value, varied_point.y.value, varied_point.z.value};
    Nested work{};
    for (std::size_t r = 0; r < n; ++r) work += lambda(p, r, motion) * rows[r];
    const auto at_contact = [&](const Nested& scalar) {
      ReactionWrench reaction = reaction_at_I(scalar);
      reaction.torque -= cross(point, reaction.force);
      return reaction;
    };
    const ReactionWrench reaction = at_contact(work);
    out.force = spread(out.pair, relative_wrench(reaction), wanted);
    // Both markers are at the point of contact.
    out.pair.delta = {};
    out.J_follows_I = true;
    if (wanted == Partials::no) return;
    const Matrix3 R = value(out.pair.axes_J);
    for (std::size_t r = 0; r < n; ++r) {
      const ReactionWrench unit = at_contact(rows[r]);
      out.scalars.push_back({PartialBy::lambda, p.first_row + static_cast<std::int32_t>(r), R * plain(unit.force),
                             R * plain(unit.torque)});
    }
    for (std::size_t a = 0; a < m; ++a) {
      out.scalars.push_back(
          {PartialBy::position, coordinate(p, a), R * slope(reaction.force, 6 + a), R * slope(reaction.torque, 6 + a)});
    }
  }

  const SwitchSource* kinks() const override { return this; }
  // Where the direction of the curve has a kink or a jump at the contact, and where the curve ends.
  void switches(const Motion& motion, ExpressionScratch&, SwitchList& list) const override {
    for (const Placed& p : contacts_) {
      for (std::size_t a = 0; a < m; ++a)
        p.contact.element.curves[a]->switches(motion.extra[p.first_extra + a], 1, list);
    }
  }
  // Of curves by routines.
  void undefined_values(const Motion& motion, UndefinedValues& undefined) const override {
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const Placed& p = contacts_[k];
      for (std::size_t a = 0; a < m; ++a) {
        const CurveLaw* law = p.contact.element.curves[a]->law();
        if (!law) continue;
        const double u = motion.extra[p.first_extra + a];
        const auto report = [&](const std::string& reason, bool value) {
          undefined.add(UndefinedValue{&(*labels_)[k], (*labels_)[k].full_text() + ": " + reason, value});
        };
        if (const std::string reason = law->reason_of_value(u); !reason.empty()) {
          report(reason, true);
        } else if (motion.mode == AnalysisMode::linear && lacks_derivatives(p, a, motion)) {
          report(law->reason_of_derivatives(u), false);
        }
      }
    }
  }
  std::string domain_violation(const Motion& motion) const override {
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      if constexpr (requires { &E::undetermined; }) {
        const Placed& p = contacts_[k];
        std::array<double, m> u;
        for (std::size_t a = 0; a < m; ++a) u[a] = motion.extra[p.first_extra + a];
        const std::string reason = p.contact.element.undetermined(pose_of(pair_motion(motion, p.I, p.J).relative), u);
        if (!reason.empty()) return (*labels_)[k].full_text() + reason;
      }
      for (std::size_t a = 0; a < m; ++a) {
        const double u = along_motion(contacts_[k], a, motion).value;
        if (contacts_[k].contact.element.curves[a]->corner_at(u)) {
          return fmt::format("the contact of {} rests on a corner of its curve, at the parameter {:.6g}",
                             (*labels_)[k].full_text(), u);
        }
        if (contacts_[k].contact.element.curves[a]->reaches(u)) continue;
        return fmt::format("the contact of {} lies beyond the {} of its open curve, at the parameter {:.6g}",
                           (*labels_)[k].full_text(), u < 0 ? "start" : "end", u);
      }
    }
    return {};
  }

 private:
  using Nested = path::NestedDuals<seeds>;
  static constexpr double largest_step = 0.05;  // of an iteration, as part of the curve

  struct Placed {
    CurveContact<E> contact;
    MarkerPlace I, J;
    std::int32_t first_coordinate;
    std::size_t first_extra;
    std::int32_t first_row;
  };
  // Force and torque on I in the axes of J, with their variation.
  struct ReactionWrench {
    Vec3<Dual<seeds>> force, torque;
  };

  static std::int32_t coordinate(const Placed& p, std::size_t a) {
    return p.first_coordinate + static_cast<std::int32_t>(a);
  }
  static double lambda(const Placed& p, std::size_t r, const Motion& motion) {
    return motion.lambda[static_cast<std::size_t>(p.first_row) + r];
  }
  static Taylor along_motion(const Placed& p, std::size_t a, const Motion& motion) {
    const std::size_t k = p.first_extra + a;
    return {motion.extra[k], motion.extra_rate[k], motion.extra_acceleration[k]};
  }
  static std::array<Nested, m> nested_parameters(const Placed& p, const Motion& motion) {
    std::array<Nested, m> u;
    for (std::size_t a = 0; a < m; ++a) {
      u[a].value = Dual<seeds>(motion.extra[p.first_extra + a], 6 + a);
      u[a].partial[6 + a] = Dual<seeds>(1.0);
    }
    return u;
  }
  // Whether what a linear model takes of the rows is no number for want of a derivative of that curve.
  static bool lacks_derivatives(const Placed& p, std::size_t a, const Motion& motion) {
    const PairMotion pair = pair_motion(motion, p.I, p.J);
    std::array<TimeTaylor<Dual<seeds>>, m> u;
    for (std::size_t b = 0; b < m; ++b) u[b] = path::constant<seeds>(along_motion(p, b, motion));
    u[a].value.partial[6 + a] = 1.0;
    for (const auto& row : p.contact.element.rows(path::seeded<seeds>(pair.relative), u)) {
      if (!std::isfinite(row.acceleration.partial[6 + a]) || !std::isfinite(row.rate.partial[6 + a])) return true;
    }
    return !std::isfinite(reaction_work(p, pair, motion).partial[6 + a].partial[6 + a]);
  }
  // Σ λ Φ with gradient and second variation.
  static Nested reaction_work(const Placed& p, const PairMotion& pair, const Motion& motion) {
    const auto rows = p.contact.element.rows(path::nested<seeds>(pair.relative), nested_parameters(p, motion));
    Nested work{};
    for (std::size_t r = 0; r < n; ++r) work += lambda(p, r, motion) * rows[r];
    return work;
  }
  static ReactionWrench reaction_at_I(const Nested& work) {
    const auto& g = work.partial;
    return {{g[0], g[1], g[2]}, {g[3], g[4], g[5]}};
  }
  static Vector plain(const Vec3<Dual<seeds>>& v) { return {v.x.value, v.y.value, v.z.value}; }
  static Vector slope(const Vec3<Dual<seeds>>& v, std::size_t seed) {
    return {v.x.partial[seed], v.y.partial[seed], v.z.partial[seed]};
  }
  static RelativeWrench relative_wrench(const ReactionWrench& reaction) {
    RelativeWrench w;
    w.force = plain(reaction.force), w.torque = plain(reaction.torque);
    for (std::size_t i = 0; i < 6; ++i) {
      const Dual<seeds>& component = i < 3 ? reaction.force[i] : reaction.torque[i - 3];
      for (std::size_t k = 0; k < 6; ++k) w.on_pose[i][k] = component.partial[k];
    }
    return w;
  }

  std::vector<Placed> contacts_;
  std::vector<Follower> followers_;
  std::vector<StartCondition> starts_;
  std::vector<std::pair<std::size_t, std::size_t>> start_places_;  // contact, parameter
  const std::vector<ElementLabel>* labels_;
};

// The elements of such a statement: Written holds its arguments, E is the member of the family.
template <class Written, class E>
class CurveContactSet : public TypedSet<Written> {
 public:
  using TypedSet<Written>::TypedSet;
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<CurveContactKernel<E>>(contacts_, this->labels, layout);
  }

 protected:
  std::vector<CurveContact<E>> contacts_;
};

template <class Set, class Written>
constexpr Kind curve_contact(std::string_view statement, std::string_view summary) {
  return Kind{statement,
              "",
              summary,
              Kind::Role::element,
              detail::argument_infos<Written>,
              [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<Set>(kind); }}
      .deactivatable();
}

}  // namespace dynalin

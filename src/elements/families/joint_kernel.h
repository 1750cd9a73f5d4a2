// The equations of joints from the rows that a member of the family gives (joint.h): reactions, what bodies start with,
// which axes are held.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "elements/families/pair_row.h"
#include "mechanics/held_axes.h"
#include "mechanics/kernel.h"
#include "mechanics/path.h"
#include "mechanics/start_displacement_source.h"
#include "mechanics/start_source.h"
#include "mechanics/wrench_source.h"

namespace dynalin {

// Angle from x_J to x_I about z_J, and displacement of I along z_J.
template <class T>
T joint_rotation(const RelativeFrame<T>& I) {
  using std::atan2;
  return atan2(I.x.y, I.x.x);
}
template <class T>
T joint_translation(const RelativeFrame<T>& I) {
  return I.p.z;
}

// Adds the gradient of a position row, from duals in the axes of J.
template <class Row>
void add_pair_row(std::int32_t row, const PairMotion& pair, const Row& phi, ConstraintRows& rows) {
  const auto partial = [&](std::size_t k) {
    return Taylor(phi.value.partial[k], phi.rate.partial[k], phi.acceleration.partial[k]);
  };
  add_gradient(row, pair, {partial(0), partial(1), partial(2)}, {partial(3), partial(4), partial(5)}, rows);
}

// The reaction λ·rows on I in the axes of J with its variation, from nested duals.
template <std::size_t n>
RelativeWrench reaction(const std::array<path::NestedDual, n>& rows, std::span<const double> lambda) {
  RelativeWrench w;
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t i = 0; i < 6; ++i) {
      const Dual<6>& gradient = rows[r].partial[i];
      (i < 3 ? w.force[i] : w.torque[i - 3]) += lambda[r] * gradient.value;
      for (std::size_t k = 0; k < 6; ++k) w.on_pose[i][k] += lambda[r] * gradient.partial[k];
    }
  }
  return w;
}

// The multiplier of a row as a scalar that the wrench on I depends on.
inline void add_multiplier(const path::NestedDual& phi, std::int32_t row, MarkerWrench& out) {
  const Matrix3 R = value(out.pair.axes_J);
  const auto g = [&](std::size_t i) { return phi.partial[i].value; };
  out.scalars.push_back({PartialBy::lambda, row, R * Vector{g(0), g(1), g(2)}, R * Vector{g(3), g(4), g(5)}});
}

// What a joint asks of the start: displacement [length or rad] and velocity of its freedom.
struct JointStart {
  std::optional<double> displacement, velocity;
  std::string_view argument{};
};

// One joint with what its rows need beyond the markers.
template <class E>
struct Joint {
  static constexpr std::size_t n = E::row_kinds.size();

  E element;
  MarkerId i, j;
  std::array<double, n> offset{};  // subtracted from the rows
  JointStart rotation, translation;

  template <class T>
  std::array<T, n> rows(const RelativeFrame<T>& I) const {
    return element.rows(I);
  }
};

template <class E>
class JointKernel final : public Kernel,
                          public WrenchSource,
                          public StartSource,
                          public StartDisplacementSource,
                          public HeldAxes {
 public:
  static constexpr std::size_t n = Joint<E>::n;

  JointKernel(const std::vector<Joint<E>>& joints, const std::vector<ElementLabel>& labels, Layout& layout) {
    for (std::size_t k = 0; k < joints.size(); ++k) {
      Placed placed{joints[k], layout.marker(joints[k].i), layout.marker(joints[k].j), 0};
      for (std::size_t r = 0; r < n; ++r) {
        const std::int32_t row = layout.add_row(labels[k], name_of(E::row_kinds[r]));
        layout.rows[static_cast<std::size_t>(row)].perpendicular = perpendicular_axes(E::row_kinds[r]).has_value();
        if (r == 0) placed.first_row = row;
      }
      for (const bool turns : {true, false}) {
        const JointStart& start = turns ? joints[k].rotation : joints[k].translation;
        if (!start.displacement && !start.velocity) continue;
        starts_.push_back({&labels[k],
                           turns ? "rotation" : "translation",
                           start.displacement,
                           start.velocity,
                           {start.argument, start.argument}});
        start_places_.push_back({placed.I, placed.J, turns, k});
      }
      joints_.push_back(std::move(placed));
    }
  }

  void constraints(const Motion& motion, ConstraintRows& rows) const override {
    for (const Placed& p : joints_) {
      const PairMotion pair = pair_motion(motion, p.I, p.J);
      auto phi = p.joint.rows(path::seeded<6>(pair.relative));
      for (std::size_t r = 0; r < n; ++r) {
        if constexpr (requires { E::parameter; }) phi[r].value.value -= p.joint.offset[r];
        if constexpr (requires(const E& e) { e.period(); })
          phi[r].value.value = std::remainder(phi[r].value.value, p.joint.element.period());
        const std::int32_t row = p.first_row + static_cast<std::int32_t>(r);
        rows.set(row, {phi[r].value.value, phi[r].rate.value, phi[r].acceleration.value});
        add_pair_row(row, pair, phi[r], rows);
      }
    }
  }

  void equations(const Motion& motion, Equations& eq) const override {
    // The reaction itself is added from the constraint rows; here only its variation.
    if (!eq.wants(PartialBy::position)) return;
    for (const Placed& p : eq.share(joints_)) {
      eq.begin_constraint(p.first_row, static_cast<std::int32_t>(n));
      const PairMotion pair = pair_motion(motion, p.I, p.J);
      apply_partials(pair, spread(pair, reaction_of(p, pair, motion), Partials::yes), eq);
    }
  }
  std::size_t shares() const override { return shares_of(joints_.size()); }

  Axes held_axes() const override {
    if constexpr (!hold_z_axes(E::row_kinds)) return Axes::none;
    return has_row(E::row_kinds, PairRow::Xi_Yj) ? Axes::all : Axes::z;
  }

  const StartSource* starts() const override { return this; }
  std::span<const StartCondition> start_conditions() const override { return starts_; }
  void start_rows(const Motion& motion, std::int32_t first, ConstraintRows& rows) const override {
    for (std::size_t k = 0; k < starts_.size(); ++k) {
      const StartPlace& p = start_places_[k];
      const PairMotion pair = pair_motion(motion, p.I, p.J);
      const auto frame = path::seeded<6>(pair.relative);
      const auto q = p.turns ? joint_rotation(frame) : joint_translation(frame);
      Taylor value(q.value.value - starts_[k].displacement.value_or(q.value.value), q.rate.value, q.acceleration.value);
      if (p.turns) value.value = std::remainder(value.value, 2 * std::numbers::pi);
      rows.set(first + static_cast<std::int32_t>(k), value);
      add_pair_row(first + static_cast<std::int32_t>(k), pair, q, rows);
    }
  }

  void start_displacements(const Motion&, std::vector<StartDisplacements>& out) const override {
    for (std::size_t k = 0; k < starts_.size(); ++k) {
      const StartCondition& s = starts_[k];
      const Joint<E>& joint = joints_[start_places_[k].joint].joint;
      if (!s.displacement) continue;
      out.push_back({.terms = {{joint.i, joint.j, start_places_[k].turns}},
                     .constant = *s.displacement,
                     .of = s.owner,
                     .argument = s.arguments.displacement});
    }
  }

  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return joints_[k].joint.i; }
  MarkerId marker_J(std::size_t k) const override { return joints_[k].joint.j; }
  void wrench(const Motion& motion, std::size_t k, Partials wanted, MarkerWrench& out) const override {
    const Placed& p = joints_[k];
    out.pair = pair_motion(motion, p.I, p.J);
    out.force = spread(out.pair, reaction_of(p, out.pair, motion), wanted);
    if (wanted == Partials::no) return;
    const auto rows = p.joint.rows(path::nested(out.pair.relative));
    for (std::size_t r = 0; r < n; ++r) add_multiplier(rows[r], p.first_row + static_cast<std::int32_t>(r), out);
  }

 private:
  struct Placed {
    Joint<E> joint;
    MarkerPlace I, J;
    std::int32_t first_row;
  };

  static RelativeWrench reaction_of(const Placed& p, const PairMotion& pair, const Motion& motion) {
    const auto lambda = std::span(motion.lambda).subspan(static_cast<std::size_t>(p.first_row), n);
    return reaction<n>(p.joint.rows(path::nested(pair.relative)), lambda);
  }

  struct StartPlace {
    MarkerPlace I, J;
    bool turns;
    std::size_t joint;
  };
  std::vector<Placed> joints_;
  std::vector<StartCondition> starts_;
  std::vector<StartPlace> start_places_;
};

}  // namespace dynalin

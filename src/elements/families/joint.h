// Joints: rows that hold marker I to marker J, written once at position level on I as seen from J.
//
// A member of the family gives
//
//     template <class T> std::array<T, n> rows(const RelativeFrame<T>& I) const;   // all zero when joined
//     static constexpr std::array<std::string_view, n> row_names;                  // "Zi.Xj" …
//     static constexpr bool rotates, translates;       // freedoms along/about z_J that a MOTION may drive
//
// Velocity and acceleration rows, their coefficients, reactions and geometric stiffness follow. The reaction of
// row k is λ_k times its gradient: force and torque on I; the opposite acts on J's body at the same point.
#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "elements/families/markers.h"
#include "mechanics/kernel.h"
#include "mechanics/path.h"
#include "model/schema.h"

namespace dynalin {

// What MOTION and other relations need to know of a joint.
class JointSetBase : public ElementSet {
 public:
  using ElementSet::ElementSet;
  virtual MarkerId marker_I(std::size_t) const = 0;
  virtual MarkerId marker_J(std::size_t) const = 0;
  virtual bool rotates() const = 0;
  virtual bool translates() const = 0;
};

// Angle from x_J to x_I about z_J, and displacement of I along z_J.
template <class T>
T joint_rotation(const RelativeFrame<T>& I) {
  return atan2(I.x.y, I.x.x);
}
template <class T>
T joint_translation(const RelativeFrame<T>& I) {
  return I.p.z;
}

// Puts one position row with gradient from duals into the constraint rows.
template <class Row>
void put_row(std::int32_t row, const PairMotion& pair, const Row& phi, ConstraintRows& rows) {
  const auto partial = [&](std::size_t k) {
    return Taylor(phi.value.partial[k], phi.rate.partial[k], phi.acceleration.partial[k]);
  };
  rows.set(row, {phi.value.value, phi.rate.value, phi.acceleration.value});
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
  const Matrix3 R = value(out.pair.J.axes);
  const auto g = [&](std::size_t i) { return phi.partial[i].value; };
  out.scalars.push_back({Column::lambda, row, R * Vector{g(0), g(1), g(2)}, R * Vector{g(3), g(4), g(5)}});
}

template <class E>
class JointKernel final : public Kernel {
 public:
  static constexpr std::size_t n = E::row_names.size();

  JointKernel(const std::vector<E>& elements, const std::vector<ElementLabel>& labels, Layout& layout) {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      Joint joint{elements[k], layout.marker(elements[k].i), layout.marker(elements[k].j), 0};
      for (std::size_t r = 0; r < n; ++r) {
        const std::int32_t row = layout.add_row(labels[k], E::row_names[r]);
        if (r == 0) joint.first_row = row;
      }
      joints_.push_back(std::move(joint));
    }
  }

  void constraints(const Motion& motion, ConstraintRows& rows) const override {
    for (const Joint& joint : joints_) {
      const PairMotion pair = pair_motion(motion, joint.I, joint.J);
      const auto phi = joint.element.rows(path::seeded<6>(pair.relative));
      for (std::size_t r = 0; r < n; ++r) {
        put_row(joint.first_row + static_cast<std::int32_t>(r), pair, phi[r], rows);
      }
    }
  }

  void equations(const Motion& motion, Equations& eq) const override {
    // The reaction itself is added from the constraint rows; here only its variation.
    if (!eq.wants(Column::position)) return;
    for (const Joint& joint : joints_) {
      const PairMotion pair = pair_motion(motion, joint.I, joint.J);
      apply_partials(pair, spread(pair, reaction_of(joint, pair, motion), true), eq);
    }
  }

  bool has_wrench() const override { return true; }
  MarkerId marker_I(std::size_t k) const override { return joints_[k].element.i; }
  MarkerId marker_J(std::size_t k) const override { return joints_[k].element.j; }
  void wrench(const Motion& motion, std::size_t k, bool with_partials, MarkerWrench& out) const override {
    const Joint& joint = joints_[k];
    out.pair = pair_motion(motion, joint.I, joint.J);
    out.force = spread(out.pair, reaction_of(joint, out.pair, motion), with_partials);
    if (!with_partials) return;
    const auto rows = joint.element.rows(path::nested(out.pair.relative));
    for (std::size_t r = 0; r < n; ++r) {
      add_multiplier(rows[r], joint.first_row + static_cast<std::int32_t>(r), out);
    }
  }

 private:
  struct Joint {
    E element;
    MarkerPlace I, J;
    std::int32_t first_row;
  };

  static RelativeWrench reaction_of(const Joint& joint, const PairMotion& pair, const Motion& motion) {
    const auto lambda = std::span(motion.lambda).subspan(static_cast<std::size_t>(joint.first_row), n);
    return reaction<n>(joint.element.rows(path::nested(pair.relative)), lambda);
  }

  std::vector<Joint> joints_;
};

template <class E>
class JointSet final : public JointSetBase {
 public:
  using JointSetBase::JointSetBase;
  std::vector<E> elements;

  void append(ElementLabel label) override {
    labels.push_back(std::move(label));
    sound.push_back(true);
    elements.emplace_back();
  }
  void read(std::size_t k, ElementReader& reader) override { read_arguments(elements[k], reader); }
  void finish(Model& model, Diagnostics& diagnostics) override {
    const bool turns = E::row_names.size() > 3;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      check_pair(model, labels[k], elements[k].i, elements[k].j, {true, turns, turns}, diagnostics);
    }
  }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<JointKernel<E>>(elements, labels, layout);
  }
  MarkerId marker_I(std::size_t k) const override { return elements[k].i; }
  MarkerId marker_J(std::size_t k) const override { return elements[k].j; }
  bool rotates() const override { return E::rotates; }
  bool translates() const override { return E::translates; }
};

template <class E>
constexpr Kind joint() {
  return {"JOINT",
          E::variant,
          E::summary,
          Kind::Role::element,
          detail::argument_infos<E>,
          [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<JointSet<E>>(kind); }};
}

}  // namespace dynalin

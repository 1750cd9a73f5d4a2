// MOTION/id, JOINT= [, ROTATION | TRANSLATION], FUNCTION= [, DISPLACEMENT]
//
// Drives the free displacement of a joint by a function of time:
//
//     θ(I,J) − f(t) = 0   or   p_z − f(t) = 0
//
// with θ the angle from x_J to x_I about z_J (radians, compared modulo 2π) and p_z the displacement of I along z_J.
#include <fmt/format.h>

#include <numbers>

#include "elements/families/joint.h"
#include "mechanics/bound_expression.h"

namespace dynalin {

namespace {

struct JointMotion {
  JointRef joint;
  bool rotation = false, translation = false;
  bool displacement = false, velocity = false, acceleration = false;
  Expression function;  // [rad] or [length]
  MarkerId i, j;        // of the joint, filled when the model is complete
  bool turns = false;

  static constexpr std::array<Argument<JointMotion>, 7> arguments = {{
      {.name = "JOINT", .slot = &JointMotion::joint, .required = true, .help = "the joint that is driven"},
      {.name = "ROTATIONAL", .slot = &JointMotion::rotation, .help = "drives the rotation"},
      {.name = "TRANSLATIONAL", .slot = &JointMotion::translation, .help = "drives the translation"},
      {.name = "FUNCTION", .slot = &JointMotion::function, .required = true, .help = "a function of TIME alone"},
      {.name = "DISPLACEMENT", .slot = &JointMotion::displacement, .help = "FUNCTION is the displacement"},
      {.name = "VELOCITY", .slot = &JointMotion::velocity, .help = "FUNCTION is the velocity: not available yet"},
      {.name = "ACCELERATION",
       .slot = &JointMotion::acceleration,
       .help = "FUNCTION is the acceleration: not available yet"},
  }};

  // Rows as functions of I seen from J; `f` is subtracted by the kernel.
  template <class T>
  std::array<T, 1> rows(const RelativeFrame<T>& I) const {
    return {turns ? joint_rotation(I) : joint_translation(I)};
  }
};

class MotionKernel final : public Kernel {
 public:
  MotionKernel(const std::vector<JointMotion>& elements, const std::vector<ElementLabel>& labels, Layout& layout) {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const JointMotion& e = elements[k];
      motions_.push_back({e,
                          layout.marker(e.i),
                          layout.marker(e.j),
                          layout.add_row(labels[k], e.turns ? "rotation" : "translation"),
                          {}});
    }
  }

  void bind(const Signals& signals) override {
    for (Driven& m : motions_) m.function = BoundExpression(m.element.function, signals);
  }

  void constraints(const Motion& motion, ConstraintRows& rows) const override {
    for (const Driven& m : motions_) {
      const PairMotion pair = pair_motion(motion, m.I, m.J);
      auto phi = m.element.rows(path::seeded<6>(pair.relative))[0];
      const Taylor f = m.function.along_motion(motion, rows.scratch);
      phi.value.value -= f.value;
      phi.rate.value -= f.rate;
      phi.acceleration.value -= f.acceleration;
      if (m.element.turns) phi.value.value = std::remainder(phi.value.value, 2 * std::numbers::pi);
      put_row(m.row, pair, phi, rows);
    }
  }

  void equations(const Motion& motion, Equations& eq) const override {
    if (!eq.wants(Column::position)) return;
    for (const Driven& m : motions_) {
      const PairMotion pair = pair_motion(motion, m.I, m.J);
      apply_partials(pair, spread(pair, reaction_of(m, pair, motion), true), eq);
    }
  }

  bool has_wrench() const override { return true; }
  MarkerId marker_I(std::size_t k) const override { return motions_[k].element.i; }
  MarkerId marker_J(std::size_t k) const override { return motions_[k].element.j; }
  void wrench(const Motion& motion, std::size_t k, bool with_partials, MarkerWrench& out) const override {
    const Driven& m = motions_[k];
    out.pair = pair_motion(motion, m.I, m.J);
    out.force = spread(out.pair, reaction_of(m, out.pair, motion), with_partials);
    if (with_partials) {
      const auto row = m.element.rows(path::nested(out.pair.relative))[0];
      add_multiplier(row, m.row, out);
    }
  }

 private:
  struct Driven {
    JointMotion element;
    MarkerPlace I, J;
    std::int32_t row;
    BoundExpression function;
  };
  static RelativeWrench reaction_of(const Driven& m, const PairMotion& pair, const Motion& motion) {
    return reaction<1>(m.element.rows(path::nested(pair.relative)),
                       std::span(motion.lambda).subspan(static_cast<std::size_t>(m.row), 1));
  }
  std::vector<Driven> motions_;
};

class MotionSet final : public TypedSet<JointMotion> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    JointMotion& m = elements[k];
    if (!read_arguments(m, reader)) return;
    if (m.velocity || m.acceleration) {
      reader.error("argument-not-built", reader.at(m.velocity ? "VELOCITY" : "ACCELERATION"),
                   fmt::format("{} of MOTION is not available yet", m.velocity ? "VELOCITY" : "ACCELERATION"));
    }
    for (const Atom& atom : m.function.atoms()) {
      if (atom.function->family == AtomFamily::time) continue;
      reader.error("function-of-state", atom.at,
                   fmt::format("FUNCTION of {} depends on {}, it may depend on TIME only", reader.label().text(),
                               atom.function->name));
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      JointMotion& m = elements[k];
      const auto* joints = dynamic_cast<const JointSetBase*>(&model.set(m.joint));
      const auto index = static_cast<std::size_t>(m.joint.index);
      if (!joints) continue;
      const bool both = joints->rotates() && joints->translates();
      const bool neither = !joints->rotates() && !joints->translates();
      const std::string joint = model.label(m.joint).text();
      if (neither) {
        diagnostics.error("undrivable-joint", labels[k].at,
                          fmt::format("{} drives {}, a {} joint, which has no freedom to drive", labels[k].text(),
                                      joint, joints->kind().variant));
        continue;
      }
      if ((m.rotation && !joints->rotates()) || (m.translation && !joints->translates()) ||
          (m.rotation && m.translation) || (both && !m.rotation && !m.translation)) {
        diagnostics.error("wrong-freedom", labels[k].at,
                          fmt::format("{} must name the freedom of {} that it drives", labels[k].text(), joint),
                          both                ? "ROTATION or TRANSLATION"
                          : joints->rotates() ? "ROTATION"
                                              : "TRANSLATION");
        continue;
      }
      m.turns = both ? m.rotation : joints->rotates();
      m.i = joints->marker_I(index);
      m.j = joints->marker_J(index);
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<MotionKernel>(elements, labels, layout);
  }
};

}  // namespace

extern constinit const Kind joint_motion = {
    "MOTION",
    "",
    "Drives the displacement of a joint as a function of time.",
    Kind::Role::element,
    detail::argument_infos<JointMotion>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<MotionSet>(kind); }};

}  // namespace dynalin

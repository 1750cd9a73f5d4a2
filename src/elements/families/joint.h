// Joints and joint primitives: rows that hold marker I to marker J, written once at position level on I as seen
// from J.
//
// A member of the family gives
//
//     template <class T> static std::array<T, n> rows(const RelativeFrame<T>& I);   // all zero when joined
//     static constexpr std::array row_kinds;                // which they are: PairRow::Zi_Xj …
//     static constexpr Uses uses;                           // the orientations of which bodies its rows depend on
//     static constexpr std::string_view variant, summary;
//
// and, where it is so,
//
//     static constexpr bool rotates, translates;   // freedoms about and along z_J that MOTION, COUPLER, GEAR take
//     static constexpr std::string_view parameter; // PITCH or PD: rows is no longer static, the member is made
//                                                  // from the value, and every row is measured from the drawing
//     double period() const;                       // rows that contain an angle repeat with it
//     static constexpr std::string_view axes;      // what its axes stand for, said where they are drawn impossibly
//     static constexpr JointSurfaces surfaces;     // on which it slips, where FRICTION may act
//     static constexpr std::array<std::size_t, 2> bars;  // of a cross: which axes of I and of J lie along its bars
//
// Velocity and acceleration rows, their coefficients, reactions and geometric stiffness follow. The reaction of
// row k is λ_k times its gradient: force and torque on I; the opposite acts on J's body at the same point.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string_view>
#include <vector>

#include "elements/families/drawn_axes.h"
#include "elements/families/markers.h"
#include "mechanics/held_axes.h"
#include "mechanics/kernel.h"
#include "mechanics/path.h"
#include "mechanics/start_source.h"
#include "mechanics/wrench_source.h"
#include "model/schema.h"

namespace dynalin {

enum class Uses : std::uint8_t { no_orientation, orientation_of_J, both_orientations };
enum class JointSurfaces : std::uint8_t { none, slide, hinge, sleeve, cross, ball };

inline constexpr std::string_view obsolete_friction = "obsolete, ignored";

struct JointArguments {
  Obsolete friction;
  MarkerId i, j;
  std::optional<double> pitch, pd;
  std::vector<double> ic, ictran, icrot;

  static constexpr std::array<Argument<JointArguments>, 24> arguments = {{
      {.name = "I", .slot = &JointArguments::i, .required = true, .help = "marker on the first body"},
      {.name = "J", .slot = &JointArguments::j, .required = true, .help = "marker on the second body"},
      {.name = "PITCH", .slot = &JointArguments::pitch, .unit = unit::length, .help = "SCREW: advance in one turn"},
      {.name = "PD",
       .slot = &JointArguments::pd,
       .unit = unit::length,
       .help = "RACKPIN: pitch diameter of the pinion"},
      {.name = "IC",
       .slot = &JointArguments::ic,
       .help = "REVOLUTE, TRANSLATIONAL: displacement [, velocity] at the start",
       .start = StatedStart::alone},
      {.name = "ICTRAN",
       .slot = &JointArguments::ictran,
       .help = "CYLINDRICAL: the same along z",
       .start = StatedStart::alone},
      {.name = "ICROT",
       .slot = &JointArguments::icrot,
       .help = "CYLINDRICAL: the same about z",
       .start = StatedStart::alone},
      // Friction as old datasets have it. It was moved to a statement of its own.
      {.name = "FRICTION", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "MU_STAT_ROT", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "MU_DYN_ROT", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "MU_STAT_TRANS", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "MU_DYN_TRANS", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "MAX_FRIC_ROT", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "INNER_RADIUS", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "OUTER_RADIUS", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "HEIGHT", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "WIDTH", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "DELTA_V", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "MAXIMUM_DEFORMATION", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "PRELOAD_RADIAL", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "PRELOAD_AXIAL", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "PRELOAD_X", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "PRELOAD_Y", .slot = &JointArguments::friction, .help = obsolete_friction},
      {.name = "PRELOAD_ONLY", .slot = &JointArguments::friction, .help = obsolete_friction},
  }};
};

struct PrimitiveArguments {
  MarkerId i, j;

  static constexpr std::array<Argument<PrimitiveArguments>, 2> arguments = {{
      {.name = "I", .slot = &PrimitiveArguments::i, .required = true, .help = "marker on the first body"},
      {.name = "J", .slot = &PrimitiveArguments::j, .required = true, .help = "marker on the second body"},
  }};
};

// What MOTION, other relations and FRICTION need to know of a joint.
class JointSetBase : public ElementSet {
 public:
  using ElementSet::ElementSet;
  virtual MarkerId marker_I(std::size_t) const = 0;
  virtual MarkerId marker_J(std::size_t) const = 0;
  virtual bool rotates() const = 0;
  virtual bool translates() const = 0;
  virtual JointSurfaces surfaces() const = 0;
  virtual std::array<std::size_t, 2> bars() const = 0;  // of a cross
};

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
class JointKernel final : public Kernel, public WrenchSource, public StartSource, public HeldAxes {
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
        start_places_.push_back({placed.I, placed.J, turns});
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
      apply_partials(pair, spread(pair, reaction_of(p, pair, motion), true), eq);
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

  const WrenchSource* wrenches() const override { return this; }
  MarkerId marker_I(std::size_t k) const override { return joints_[k].joint.i; }
  MarkerId marker_J(std::size_t k) const override { return joints_[k].joint.j; }
  void wrench(const Motion& motion, std::size_t k, bool with_partials, MarkerWrench& out) const override {
    const Placed& p = joints_[k];
    out.pair = pair_motion(motion, p.I, p.J);
    out.force = spread(out.pair, reaction_of(p, out.pair, motion), with_partials);
    if (!with_partials) return;
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
  };
  std::vector<Placed> joints_;
  std::vector<StartCondition> starts_;
  std::vector<StartPlace> start_places_;
};

template <class E, class Written>
class JointSet final : public JointSetBase {
 public:
  using JointSetBase::JointSetBase;
  std::vector<Joint<E>> joints;

  void append(ElementLabel label) override {
    labels.push_back(std::move(label));
    sound.push_back(true);
  }
  void make(std::size_t k) override { joints.resize(k + 1); }
  void read(std::size_t k, ElementReader& reader) override {
    Written w;
    const bool ok = read_arguments(w, reader);
    if constexpr (std::is_same_v<Written, JointArguments>) {
      read_parameter(w.pitch, "PITCH", joints[k].element, reader);
      read_parameter(w.pd, "PD", joints[k].element, reader);
      const bool both = rotates() && translates();
      read_start(w.ic, "IC",
                 !both && rotates()      ? &joints[k].rotation
                 : !both && translates() ? &joints[k].translation
                                         : nullptr,
                 reader);
      read_start(w.ictran, "ICTRAN", both ? &joints[k].translation : nullptr, reader);
      read_start(w.icrot, "ICROT", both ? &joints[k].rotation : nullptr, reader);
      warn_of_obsolete(reader);
    }
    if (ok) joints[k].i = w.i, joints[k].j = w.j;
  }
  void finish(Model& model, Diagnostics& diagnostics) override {
    constexpr PairRequirements needs{true, E::uses == Uses::both_orientations, E::uses != Uses::no_orientation};
    for (std::size_t k = 0; k < joints.size(); ++k) {
      Joint<E>& joint = joints[k];
      if (!check_pair(model, labels[k], joint.i, joint.j, needs, diagnostics)) continue;
      constexpr std::string_view axes = [] {
        if constexpr (requires { E::axes; }) return E::axes;
        return std::string_view();
      }();
      check_drawn_axes(model, labels[k], joint.i, joint.j, E::row_kinds, axes, diagnostics);
      const RelativeFrame<double> drawn = drawn_frame(model, joint.i, joint.j);
      if constexpr (requires { E::parameter; }) joint.offset = joint.rows(drawn);
      if (E::row_kinds.size() >= 4 && (rotates() || translates()) && drawn.z.z < 0) {
        diagnostics.warning(
            "opposed-axes", labels[k].at,
            fmt::format("the z axes of the markers of {} point in opposite directions", labels[k].full_text()),
            "the joint holds them like that");
      }
    }
  }
  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<JointKernel<E>>(joints, labels, layout);
  }
  MarkerId marker_I(std::size_t k) const override { return joints[k].i; }
  MarkerId marker_J(std::size_t k) const override { return joints[k].j; }
  bool rotates() const override {
    if constexpr (requires { E::rotates; }) return E::rotates;
    return false;
  }
  bool translates() const override {
    if constexpr (requires { E::translates; }) return E::translates;
    return false;
  }
  JointSurfaces surfaces() const override {
    if constexpr (requires { E::surfaces; }) return E::surfaces;
    return JointSurfaces::none;
  }
  std::array<std::size_t, 2> bars() const override {
    if constexpr (requires { E::bars; }) return E::bars;
    return {};
  }

 private:
  static void warn_of_obsolete(ElementReader& reader) {
    std::vector<std::string_view> given;
    for (const ElementReader::Assignment& a : reader.assignments) {
      const auto is_it = [&](const Argument<JointArguments>& known) {
        return known.name == a.name && known.help == obsolete_friction;
      };
      if (std::any_of(JointArguments::arguments.begin(), JointArguments::arguments.end(), is_it))
        given.push_back(a.name);
    }
    if (given.empty()) return;
    reader.warning("obsolete-argument", reader.at(given.front()),
                   fmt::format("friction as an argument of {} is obsolete and ignored: {}", reader.label().text(),
                               fmt::join(given, ", ")),
                   "the statement FRICTION replaces it");
  }
  static void read_start(const std::vector<double>& values, std::string_view name, JointStart* start,
                         ElementReader& reader) {
    if (values.empty()) return;
    if (!start) {
      reader.error("unexpected-argument", reader.at(name), fmt::format("{} does not go with {}", name, E::variant));
    } else if (values.size() > 2) {
      reader.error("wrong-count", reader.at(name),
                   fmt::format("{} takes a displacement and a velocity, here are {} values", name, values.size()));
    } else {
      start->argument = name;
      start->displacement = values[0];
      if (values.size() == 2) start->velocity = values[1];
    }
  }
  static void read_parameter(const std::optional<double>& value, std::string_view name, E& element,
                             ElementReader& reader) {
    constexpr std::string_view wanted = [] {
      if constexpr (requires { E::parameter; }) return E::parameter;
      return std::string_view();
    }();
    if (name != wanted) {
      if (value) {
        reader.error("unexpected-argument", reader.at(name), fmt::format("{} does not go with {}", name, E::variant));
      }
      return;
    }
    if constexpr (requires { E::parameter; }) {
      if (!value && !reader.statement().damaged && !reader.given(name)) {
        reader.error("missing-argument", reader.statement().at,
                     fmt::format("{} needs {}", reader.label().text(), name));
      } else if (value && *value == 0) {
        reader.error("value-out-of-range", reader.at(name),
                     fmt::format("{} of {} is zero", name, reader.label().text()));
      } else if (value) {
        element = E{*value};
      }
    }
  }
};

template <class E>
constexpr Kind joint() {
  return Kind{"JOINT",
              E::variant,
              E::summary,
              Kind::Role::element,
              detail::argument_infos<JointArguments>,
              [](const Kind& kind) -> std::unique_ptr<ElementSet> {
                return std::make_unique<JointSet<E, JointArguments>>(kind);
              }}
      .deactivatable();
}

template <class E>
constexpr Kind primitive() {
  return Kind{"JPRIM",
              E::variant,
              E::summary,
              Kind::Role::element,
              detail::argument_infos<PrimitiveArguments>,
              [](const Kind& kind) -> std::unique_ptr<ElementSet> {
                return std::make_unique<JointSet<E, PrimitiveArguments>>(kind);
              }}
      .deactivatable();
}

}  // namespace dynalin

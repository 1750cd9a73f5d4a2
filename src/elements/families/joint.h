// Joints and joint primitives as they are stated: rows that hold marker I to marker J, written once at position level
// on I as seen from J (joint_kernel.h).
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
#include <memory>
#include <string_view>
#include <vector>

#include "elements/families/drawn_axes.h"
#include "elements/families/joint_kernel.h"
#include "elements/families/markers.h"
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

template <class E>
constexpr bool joint_rotates() {
  if constexpr (requires { E::rotates; }) return E::rotates;
  return false;
}
template <class E>
constexpr bool joint_translates() {
  if constexpr (requires { E::translates; }) return E::translates;
  return false;
}
template <class E>
constexpr std::string_view joint_parameter() {
  if constexpr (requires { E::parameter; }) return E::parameter;
  return {};
}

// Whether an argument of joints goes with joints of this type.
template <class E>
constexpr bool goes_with_joint(std::string_view argument) {
  constexpr bool rotates = joint_rotates<E>(), translates = joint_translates<E>();
  if (argument == "PITCH" || argument == "PD") return argument == joint_parameter<E>();
  if (argument == "IC") return rotates != translates;
  if (argument == "ICTRAN" || argument == "ICROT") return rotates && translates;
  return true;
}

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
      read_start(w.ic, "IC", rotates() ? joints[k].rotation : joints[k].translation, reader);
      read_start(w.ictran, "ICTRAN", joints[k].translation, reader);
      read_start(w.icrot, "ICROT", joints[k].rotation, reader);
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
  bool rotates() const override { return joint_rotates<E>(); }
  bool translates() const override { return joint_translates<E>(); }
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
  static void read_start(const std::vector<double>& values, std::string_view name, JointStart& start,
                         ElementReader& reader) {
    if (values.empty()) return;
    if (!goes_with_joint<E>(name)) {
      reader.error("unexpected-argument", reader.at(name), fmt::format("{} does not go with {}", name, E::variant));
    } else if (values.size() > 2) {
      reader.error("wrong-count", reader.at(name),
                   fmt::format("{} takes a displacement and a velocity, here are {} values", name, values.size()));
    } else {
      start.argument = name;
      start.displacement = values[0];
      if (values.size() == 2) start.velocity = values[1];
    }
  }
  static void read_parameter(const std::optional<double>& value, std::string_view name, E& element,
                             ElementReader& reader) {
    if (!goes_with_joint<E>(name)) {
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

// A change of type drops what does not go with the new one.
template <class E>
inline constexpr auto joint_argument_infos = [] {
  auto infos = detail::argument_infos<JointArguments>;
  for (ArgumentInfo& info : infos) info.elsewhere = !goes_with_joint<E>(info.name);
  return infos;
}();

template <class E>
constexpr Kind joint() {
  return Kind{"JOINT",
              E::variant,
              E::summary,
              Kind::Role::element,
              joint_argument_infos<E>,
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

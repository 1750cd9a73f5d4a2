// FRICTION/id, JOINT=, MU_STATIC=, MU_DYNAMIC=, STICTION_TRANSITION_VELOCITY=, TRANSITION_VELOCITY_COEFFICIENT=,
//     MAX_STICTION_DEFORMATION=, PIN_RADIUS=, FRICTION_ARM=, BENDING_REACTION_ARM=, BALL_RADIUS=, REACTION_ARM=,
//     INITIAL_OVERLAP=, OVERLAP_DELTA=, FRICTION_FORCE_PRELOAD=, FRICTION_TORQUE_PRELOAD=, EFFECT=, INPUTS=,
//     INACTIVE=STATIC, I_YOKE | J_YOKE, FORMULATION=, BRISTLE_STIFFNESS_COEFFICIENT=, DAMPING_COEFFICIENT=,
//     VISCOUS_FRICTION_COEFFICIENT=
//
// Dry friction in a joint. With the coefficient μ and the direction s of friction_law.h, and the reaction of the joint
// on I as a force F and a moment T along and across the axis of the joint, it exerts on I, and the opposite on J,
//
//     TRANSLATIONAL      −s (μ (F_across + T_across/X_s + |T_along|/R_a) + FRICTION_FORCE_PRELOAD)    along z of J
//     REVOLUTE           −s (μ (R_p F_across + R_n |F_along| + R_p/R_b T_across) + FRICTION_TORQUE_PRELOAD)    about z
//     HOOKE, UNIVERSAL   the same about the bar of the cross that is fixed on I (I_YOKE) or on J (J_YOKE)
//     CYLINDRICAL        N = μ (F_across + T_across/X_s): −s₁ (N + force preload) along z of J and
//                        −s₂ (R_p N + torque preload) about it, with s of the slip (z′, R_p ω)
//     SPHERICAL          −s (μ R_ball F + FRICTION_TORQUE_PRELOAD), a vector with the slip R_ball ω
//
// Slip is that of the surfaces: R_p ω in a hinge. INPUTS says which of the terms count. These magnitudes, the defaults
// of the coefficients and what happens in a CYLINDRICAL joint are inferred, no published text has them; so are the
// names of the last four arguments, which modelling programs use.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/enumeration.h"
#include "elements/families/friction_coefficients.h"
#include "elements/families/joint.h"
#include "elements/families/markers.h"
#include "elements/forces/friction_kernel.h"
#include "elements/forces/friction_unread.h"
#include "elements/forces/friction_words.h"
#include "model/model.h"

namespace dynalin {

namespace {

struct Friction {
  JointRef joint;
  double mu_static = FrictionLaw().mu_static, mu_dynamic = FrictionLaw().mu_dynamic;
  double stiction_velocity = FrictionLaw().stiction_velocity, transition = FrictionLaw().transition;
  double largest_deformation = FrictionLaw().largest_deformation;
  double pin_radius = 1, friction_arm = 1, bending_arm = 1, ball_radius = 1, reaction_arm = 1, overlap = 1000;
  double force_preload = 0, torque_preload = 0;
  std::vector<std::string> overlap_delta, effect, inputs, inactive, formulation;
  std::optional<double> bristle_stiffness;
  double bristle_damping = 0, viscosity = 0;
  bool i_yoke = false, j_yoke = false;
  bool counts_preload = true;                                          // as INPUTS has it
  std::vector<std::pair<std::string_view, Span>> stated, input_words;  // arguments, and words of INPUTS

  using F = Friction;
  static constexpr std::array<Argument<F>, 24> arguments = {{
      {.name = "JOINT", .slot = &F::joint, .required = true, .help = "the joint whose surfaces rub"},
      {.name = "MU_STATIC", .slot = &F::mu_static, .minimum = 0, .help = "coefficient in stiction"},
      {.name = "MU_DYNAMIC", .slot = &F::mu_dynamic, .minimum = 0, .help = "coefficient in sliding"},
      {.name = "STICTION_TRANSITION_VELOCITY",
       .slot = &F::stiction_velocity,
       .unit = unit::velocity,
       .help = "slip at which stiction ends, more than 0"},
      {.name = "TRANSITION_VELOCITY_COEFFICIENT",
       .slot = &F::transition,
       .help = "times that slip at which sliding begins, more than 1"},
      {.name = "MAX_STICTION_DEFORMATION",
       .slot = &F::largest_deformation,
       .unit = unit::length,
       .help = "largest creep in stiction, more than 0"},
      {.name = "PIN_RADIUS",
       .slot = &F::pin_radius,
       .unit = unit::length,
       .help = "of the surface that slips, but for TRANSLATIONAL and SPHERICAL"},
      {.name = "FRICTION_ARM",
       .slot = &F::friction_arm,
       .unit = unit::length,
       .help = "REVOLUTE, HOOKE, UNIVERSAL: of friction by the axial force"},
      {.name = "BENDING_REACTION_ARM",
       .slot = &F::bending_arm,
       .unit = unit::length,
       .help = "REVOLUTE, HOOKE, UNIVERSAL: of the forces that bear the bending moment"},
      {.name = "BALL_RADIUS", .slot = &F::ball_radius, .unit = unit::length, .help = "SPHERICAL"},
      {.name = "REACTION_ARM",
       .slot = &F::reaction_arm,
       .unit = unit::length,
       .help = "TRANSLATIONAL: of the forces that bear the moment about the axis"},
      {.name = "INITIAL_OVERLAP",
       .slot = &F::overlap,
       .unit = unit::length,
       .help = "TRANSLATIONAL, CYLINDRICAL: of the parts as drawn, what bears the bending moment"},
      {.name = "OVERLAP_DELTA",
       .slot = &F::overlap_delta,
       .help = "CONSTANT, or how the overlap goes with displacement along z of J: INCREASE, DECREASE"},
      {.name = "FRICTION_FORCE_PRELOAD",
       .slot = &F::force_preload,
       .unit = unit::force,
       .minimum = 0,
       .help = "friction without any reaction"},
      {.name = "FRICTION_TORQUE_PRELOAD",
       .slot = &F::torque_preload,
       .unit = unit::torque,
       .minimum = 0,
       .help = "the same about the axis"},
      {.name = "EFFECT", .slot = &F::effect, .help = "ALL, or one of STICTION and SLIDING"},
      {.name = "INPUTS",
       .slot = &F::inputs,
       .help = "ALL, NONE, or some of PRELOAD:REACTION_FORCE:BENDING_MOMENT:TORSIONAL_MOMENT"},
      {.name = "INACTIVE", .slot = &F::inactive, .help = "STATIC: none in static and quasi-static analyses"},
      {.name = "I_YOKE",
       .slot = &F::i_yoke,
       .help = "HOOKE, UNIVERSAL: at the bar of the cross that is fixed on I",
       .ends = "J_YOKE"},
      {.name = "J_YOKE", .slot = &F::j_yoke, .help = "the same on J", .ends = "I_YOKE"},
      {.name = "FORMULATION", .slot = &F::formulation, .help = "ORIGINAL, or LUGRE"},
      {.name = "BRISTLE_STIFFNESS_COEFFICIENT",
       .slot = &F::bristle_stiffness,
       .minimum = 0,
       .help = "LUGRE: coefficient by length of creep; else MU_STATIC by MAX_STICTION_DEFORMATION"},
      {.name = "DAMPING_COEFFICIENT",
       .slot = &F::bristle_damping,
       .minimum = 0,
       .help = "LUGRE: coefficient by rate of creep"},
      {.name = "VISCOUS_FRICTION_COEFFICIENT",
       .slot = &F::viscosity,
       .minimum = 0,
       .help = "LUGRE: coefficient by slip"},
  }};
};

void read_options(Friction& e, JointFriction& out, ElementReader& reader) {
  if (const auto words = friction_words::read(e.effect, friction_words::effects, "EFFECT", reader);
      words && !words->empty()) {
    // Both together are all.
    if (among(*words, FrictionEffect::stiction) != among(*words, FrictionEffect::sliding))
      out.law.effect = words->front().choice;
  }
  const auto words = friction_words::read(e.inputs, friction_words::inputs, "INPUTS", reader);
  if (words && !words->empty() && !among(*words, FrictionInput::all)) {
    out.of_force = among(*words, FrictionInput::force), out.of_bending = among(*words, FrictionInput::bending);
    out.of_torsion = among(*words, FrictionInput::torsion);
    for (const auto& word : *words) e.input_words.emplace_back(word.name, reader.at("INPUTS"));
    e.counts_preload = among(*words, FrictionInput::preload);
    if (!e.counts_preload) out.force_preload = out.torque_preload = 0;
  }
  if (const auto changes = friction_words::read(e.overlap_delta, friction_words::overlaps, "OVERLAP_DELTA", reader))
    out.overlap_growth = among(*changes, OverlapChange::increase)   ? 1
                         : among(*changes, OverlapChange::decrease) ? -1
                                                                    : 0;
  if (const auto without = friction_words::read(e.inactive, friction_words::rests, "INACTIVE", reader))
    out.rests_in_statics = among(*without, FrictionRests::in_statics);
}

void read_bristles(const Friction& e, FrictionLaw& law, ElementReader& reader) {
  const auto words = friction_words::read(e.formulation, friction_words::formulations, "FORMULATION", reader);
  if (!words) return;
  const bool lugre = !words->empty() && words->front().choice == FrictionFormulation::lugre;
  const auto excluded = [&](std::string_view argument) {
    if (!reader.given(argument)) return;
    reader.error("unexpected-argument", reader.at(argument),
                 fmt::format("{} of {} goes with FORMULATION={}", argument, reader.label().text(),
                             lugre ? "ORIGINAL" : "LUGRE"));
  };
  if (!lugre) {
    for (const auto argument : {"BRISTLE_STIFFNESS_COEFFICIENT", "DAMPING_COEFFICIENT", "VISCOUS_FRICTION_COEFFICIENT"})
      excluded(argument);
    return;
  }
  excluded("EFFECT");
  law.effect = FrictionEffect::all;
  if (!(e.mu_static > 0) || !(e.mu_dynamic > 0)) {
    reader.error("value-out-of-range", reader.at(e.mu_static > 0 ? "MU_DYNAMIC" : "MU_STATIC"),
                 fmt::format("the coefficients of {} must be more than 0 with LUGRE", reader.label().text()));
  }
  law.formulation = FrictionFormulation::lugre;
  law.bristle_stiffness = e.bristle_stiffness.value_or(e.mu_static / e.largest_deformation);
  law.bristle_damping = e.bristle_damping, law.viscosity = e.viscosity;
}

class FrictionSet final : public TypedSet<Friction> {
 public:
  using TypedSet::TypedSet;

  void make(std::size_t k) override {
    TypedSet::make(k);
    frictions_.resize(k + 1);
  }

  void read(std::size_t k, ElementReader& reader) override {
    Friction& e = elements[k];
    if (!read_arguments(e, reader)) return;
    const auto positive = [&](double value, std::string_view name, double above = 0) {
      if (value > above) return;
      reader.error("value-out-of-range", reader.at(name),
                   fmt::format("{} of {} is {}, it must be more than {:g}", name, reader.label().text(), value, above));
    };
    positive(e.stiction_velocity, "STICTION_TRANSITION_VELOCITY");
    positive(e.transition, "TRANSITION_VELOCITY_COEFFICIENT", 1);
    positive(e.largest_deformation, "MAX_STICTION_DEFORMATION");
    positive(e.pin_radius, "PIN_RADIUS"), positive(e.ball_radius, "BALL_RADIUS");
    positive(e.friction_arm, "FRICTION_ARM"), positive(e.bending_arm, "BENDING_REACTION_ARM");
    positive(e.reaction_arm, "REACTION_ARM"), positive(e.overlap, "INITIAL_OVERLAP");
    if (e.i_yoke && e.j_yoke) {
      reader.error("excluded-arguments", reader.at("J_YOKE"),
                   fmt::format("{} takes I_YOKE or J_YOKE, not both", reader.label().text()),
                   "a second FRICTION stands for the other bar of the cross");
    }
    for (const Argument<Friction>& a : Friction::arguments) {
      if (reader.given(a.name)) e.stated.emplace_back(a.name, reader.at(a.name));
    }
    std::ranges::sort(e.stated, {}, [](const auto& argument) { return argument.second.offset; });
    JointFriction& f = frictions_[k];
    f.law.mu_static = e.mu_static, f.law.mu_dynamic = e.mu_dynamic;
    f.law.stiction_velocity = e.stiction_velocity, f.law.transition = e.transition;
    f.law.largest_deformation = e.largest_deformation;
    f.pin_radius = e.pin_radius, f.ball_radius = e.ball_radius;
    f.friction_arm = e.friction_arm, f.bending_arm = e.bending_arm;
    f.reaction_arm = e.reaction_arm, f.overlap = e.overlap;
    f.force_preload = e.force_preload, f.torque_preload = e.torque_preload;
    read_options(e, f, reader);
    read_bristles(e, f.law, reader);
    if (f.law.effect == FrictionEffect::all) warn_of_coefficient_order(e.mu_static, e.mu_dynamic, reader);
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      if (!elements[k].joint.valid()) continue;
      const auto* joints = dynamic_cast<const JointSetBase*>(&model.set(elements[k].joint));
      if (joints) take_joint(model, *joints, k, diagnostics);
    }
    report_twice(model, diagnostics);
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<JointFrictionKernel>(frictions_, labels, layout);
  }

 private:
  void take_joint(const Model& model, const JointSetBase& joints, std::size_t k, Diagnostics& diagnostics) {
    const Friction& e = elements[k];
    JointFriction& f = frictions_[k];
    const auto index = static_cast<std::size_t>(e.joint.index);
    const JointSurfaces surfaces = joints.surfaces();
    const std::string_view type = joints.kind().variant;
    const std::string joint = model.label(e.joint).full_text();
    f.joint = model.label(e.joint).id;
    f.i = joints.marker_I(index), f.j = joints.marker_J(index);
    f.joint_acts = joints.active;
    switch (surfaces) {
      case JointSurfaces::none:
        diagnostics.error(
            "unfit-joint", labels[k].at, fmt::format("{} refers to {}, a {} joint", labels[k].full_text(), joint, type),
            "friction acts in TRANSLATIONAL, REVOLUTE, CYLINDRICAL, HOOKE, UNIVERSAL and SPHERICAL joints");
        return;
      case JointSurfaces::slide:
        f.surface = FrictionSurface::slide;
        break;
      case JointSurfaces::hinge:
        f.surface = FrictionSurface::hinge;
        break;
      case JointSurfaces::sleeve:
        f.surface = FrictionSurface::sleeve;
        break;
      case JointSurfaces::cross:
        f.surface = e.j_yoke ? FrictionSurface::yoke_of_J : FrictionSurface::yoke_of_I;
        f.axis = joints.bars()[e.j_yoke ? 1 : 0];
        break;
      case JointSurfaces::ball:
        f.surface = FrictionSurface::ball;
        break;
    }
    // A ball holds point masses as well, but its friction turns them.
    if (f.surface == FrictionSurface::ball) {
      for (const MarkerId m : {f.i, f.j}) {
        if (m.valid()) check_rotation(model, labels[k], m, diagnostics);
      }
    }
    report_unread(k, {surfaces, fmt::format("{}, a {} joint", joint, type)}, diagnostics);
    if (f.i.valid() && f.j.valid()) f.drawn = drawn_frame(model, f.i, f.j);
  }

  // Of each argument once, of those for one reason together.
  struct Joint {
    JointSurfaces surfaces;
    std::string text;
  };
  void report_unread(std::size_t k, const Joint& joint, Diagnostics& diagnostics) const {
    struct Reason {
      std::string_view beside;
      std::vector<std::string_view> arguments;
      Span at;
    };
    const auto says_nothing_of_joint = [&](std::string_view name, const Span& at) {
      using friction_unread::read_by;
      const auto by = std::ranges::find(read_by, name, &friction_unread::ReadBy::name);
      if (by == read_by.end() || by->of(joint.surfaces)) return false;
      diagnostics.warning("unread-argument", at,
                          fmt::format("{} of {} says nothing of {}", name, labels[k].text(), joint.text));
      return true;
    };
    for (const auto& [word, at] : elements[k].input_words) says_nothing_of_joint(word, at);
    const Friction& e = elements[k];
    const friction_unread::FrictionStated stated{e.force_preload, e.torque_preload, e.counts_preload,
                                                 e.bristle_stiffness.has_value()};
    std::vector<Reason> reasons;
    for (const auto& [name, at] : e.stated) {
      if (says_nothing_of_joint(name, at)) continue;
      const std::string_view beside = friction_unread::unread_beside(name, stated, frictions_[k]);
      if (beside.empty()) continue;
      auto reason = std::ranges::find(reasons, beside, &Reason::beside);
      if (reason == reasons.end()) reason = reasons.insert(reason, {beside, {}, at});
      reason->arguments.push_back(name);
    }
    for (const Reason& r : reasons) {
      diagnostics.warning("unread-argument", r.at,
                          fmt::format("{} of {} {} nothing {}", enumeration(r.arguments), labels[k].text(),
                                      r.arguments.size() == 1 ? "says" : "say", r.beside));
    }
  }

  void report_twice(const Model& model, Diagnostics& diagnostics) const {
    std::map<std::pair<std::int64_t, FrictionSurface>, std::size_t> first;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      if (!elements[k].joint.valid()) continue;
      const auto [at, fresh] = first.try_emplace({frictions_[k].joint, frictions_[k].surface}, k);
      if (fresh) continue;
      diagnostics.warning("friction-twice", labels[k].at,
                          fmt::format("{} acts in {} beside {}: both count", labels[k].full_text(),
                                      model.label(elements[k].joint).full_text(), labels[at->second].full_text()));
    }
  }

  std::vector<JointFriction> frictions_;
};

}  // namespace

extern constinit const Kind friction =
    Kind{"FRICTION",
         "",
         "Dry friction in a joint, by what the joint bears.",
         Kind::Role::element,
         detail::argument_infos<Friction>,
         [](const Kind& kind) -> std::unique_ptr<ElementSet> { return std::make_unique<FrictionSet>(kind); },
         Kind::EnergyRows::one}
        .deactivatable()
        .with_example("FRICTION/1, MU_STATIC=0.3");

}  // namespace dynalin

// Which arguments of FRICTION count in which joints and beside which others, as friction_load.h and friction_law.h read
// them.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>

#include "elements/families/joint.h"
#include "elements/forces/joint_friction.h"

namespace dynalin::friction_unread {

// Arguments, and words of INPUTS, that say nothing of joints with other surfaces.
struct ReadBy {
  std::string_view name;
  std::array<bool, 6> surfaces{};  // by JointSurfaces

  constexpr ReadBy(std::string_view name_, std::initializer_list<JointSurfaces> list) : name(name_) {
    for (const JointSurfaces s : list) surfaces[static_cast<std::size_t>(s)] = true;
  }
  bool of(JointSurfaces s) const { return surfaces[static_cast<std::size_t>(s)]; }
};
inline constexpr auto read_by = [] {
  using enum JointSurfaces;
  return std::array{
      ReadBy{"PIN_RADIUS", {hinge, sleeve, cross}},
      ReadBy{"FRICTION_ARM", {hinge, cross}},
      ReadBy{"BENDING_REACTION_ARM", {hinge, cross}},
      ReadBy{"BALL_RADIUS", {ball}},
      ReadBy{"REACTION_ARM", {slide}},
      ReadBy{"INITIAL_OVERLAP", {slide, sleeve}},
      ReadBy{"OVERLAP_DELTA", {slide, sleeve}},
      ReadBy{"FRICTION_FORCE_PRELOAD", {slide, sleeve}},
      ReadBy{"FRICTION_TORQUE_PRELOAD", {hinge, sleeve, cross, ball}},
      ReadBy{"I_YOKE", {cross}},
      ReadBy{"J_YOKE", {cross}},
      ReadBy{"BENDING_MOMENT", {slide, hinge, sleeve, cross}},
      ReadBy{"TORSIONAL_MOMENT", {slide}},
  };
}();

// What is stated beside what is in a JointFriction.
struct FrictionStated {
  double force_preload = 0, torque_preload = 0;
  bool counts_preload = true;  // as INPUTS has it
  bool bristle_stiffness = false;
};

// Beside what an argument says nothing, "" if the law or the load reads it. That the joint has such surfaces is not
// asked.
inline std::string_view unread_beside(std::string_view argument, const FrictionStated& stated, const JointFriction& f) {
  const auto is = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, argument) != names.end();
  };
  const bool sliding = f.law.effect == FrictionEffect::sliding;
  const bool lugre = f.law.formulation == FrictionFormulation::lugre;
  const bool loaded = f.bears_load();
  const bool preload = (f.pushes() && f.force_preload > 0) || (f.turns() && f.torque_preload > 0);
  if (is({"FRICTION_FORCE_PRELOAD"}))
    return stated.force_preload > 0 && !stated.counts_preload ? "with INPUTS without PRELOAD" : "";
  if (is({"FRICTION_TORQUE_PRELOAD"}))
    return stated.torque_preload > 0 && !stated.counts_preload ? "with INPUTS without PRELOAD" : "";
  if (is({"FRICTION_ARM"}) && !f.of_force) return "with INPUTS without REACTION_FORCE";
  if (is({"BENDING_REACTION_ARM", "INITIAL_OVERLAP", "OVERLAP_DELTA"}) && !f.of_bending)
    return "with INPUTS without BENDING_MOMENT";
  if (is({"REACTION_ARM"}) && !f.of_torsion) return "with INPUTS without TORSIONAL_MOMENT";
  const bool of_forces = is(
      {"JOINT", "INPUTS", "FRICTION_ARM", "BENDING_REACTION_ARM", "INITIAL_OVERLAP", "OVERLAP_DELTA", "REACTION_ARM"});
  if (!of_forces && !loaded && !preload) return "without any load";
  if (is({"MU_STATIC", "MAX_STICTION_DEFORMATION", "TRANSITION_VELOCITY_COEFFICIENT", "INACTIVE"}) && sliding)
    return "with EFFECT=SLIDING";
  if (is({"MU_DYNAMIC"}) && f.law.effect == FrictionEffect::stiction) return "with EFFECT=STICTION";
  if (is({"TRANSITION_VELOCITY_COEFFICIENT"}) && lugre) return "with FORMULATION=LUGRE";
  if (is({"MAX_STICTION_DEFORMATION"}) && lugre && stated.bristle_stiffness)
    return "with BRISTLE_STIFFNESS_COEFFICIENT";
  // Coefficients of a load. Of all that fades out in sliding, with STICTION the direction goes by the transition too.
  const bool by_load = is({"MU_STATIC", "MU_DYNAMIC"}) ||
                       (is({"TRANSITION_VELOCITY_COEFFICIENT"}) && f.law.effect == FrictionEffect::all);
  if (by_load && !lugre && !loaded) return "with a preload alone";
  return "";
}

}  // namespace dynalin::friction_unread

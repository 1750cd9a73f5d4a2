// FRICTION as it is stated: which surfaces rub, and what presses them together.
#pragma once

#include <cstdint>

#include "elements/forces/friction_law.h"
#include "mechanics/path.h"

namespace dynalin {

// What slips: about or along z of J, about an axis of the cross that is fixed on I or on J, or about a ball.
enum class FrictionSurface : std::uint8_t { slide, hinge, sleeve, yoke_of_I, yoke_of_J, ball };

struct JointFriction {
  std::int64_t joint = 0;
  MarkerId i, j;  // of the joint
  FrictionSurface surface = FrictionSurface::hinge;
  std::size_t axis = 2;  // of yokes: which axis of the marker lies along the bar of the cross
  FrictionLaw law;

  double pin_radius = 1, ball_radius = 1;        // [length]
  double friction_arm = 1, bending_arm = 1;      // [length]
  double reaction_arm = 1, overlap = 1000;       // [length]
  double overlap_growth = 0;                     // by displacement along z of J: 1, −1 or 0
  RelativeFrame<double> drawn;                   // I seen from J
  double force_preload = 0, torque_preload = 0;  // [force], [force·length]
  bool of_force = true, of_bending = true, of_torsion = true;
  bool rests_in_statics = false;
  bool joint_acts = true;  // false while the joint is out of the model: no friction then, and no bristles

  // The components of w: a force along z of J, torques about the axes of J or the bar of the cross.
  std::size_t component_count() const {
    return surface == FrictionSurface::ball ? 3 : surface == FrictionSurface::sleeve ? 2 : 1;
  }
  // Of a component of w against the force on the surface [length, or 1].
  double lever(std::size_t component) const {
    if (surface == FrictionSurface::ball) return ball_radius;
    return pushes() && component == 0 ? 1.0 : pin_radius;
  }
  // Along or about z of both markers, not along axes of one.
  bool is_along_common_z() const { return surface == FrictionSurface::hinge || pushes(); }
  bool pushes() const { return surface == FrictionSurface::slide || surface == FrictionSurface::sleeve; }
  bool turns() const { return surface != FrictionSurface::slide; }
  // Whether what the joint bears presses its surfaces together (friction_load.h).
  bool bears_load() const {
    return of_force || (of_bending && surface != FrictionSurface::ball) ||
           (of_torsion && surface == FrictionSurface::slide);
  }
};

}  // namespace dynalin

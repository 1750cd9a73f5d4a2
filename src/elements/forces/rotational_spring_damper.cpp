// SPRINGDAMPER/id, ROTATIONAL, I=, J=, KT=, CT=, ANGLE=, TORQUE=
//
// Spring and damper in parallel about the z axis of J.
//
//     T = TORQUE − KT (AZ(I,J) − ANGLE) − CT WZ(I,J,J)
//
// acts on I about z_J, its opposite on J. AZ counts whole turns. The z axes of I and J are meant to be parallel.
#include "elements/families/line_force.h"

namespace dynalin {

namespace {

struct RotationalSpringDamper {
  MarkerId i, j;
  double stiffness = 0;   // [force·length/rad]
  double damping = 0;     // [force·length·time/rad]
  double free_angle = 0;  // [rad]
  double preload = 0;     // [force·length] at AZ = free_angle

  ElsewhereOnly elsewhere;

  static constexpr std::string_view keyword = "SPRINGDAMPER", variant = "ROTATIONAL";
  static constexpr std::string_view summary = "Spring and damper about the z axis of marker J.";
  static constexpr bool acts_on_rotation = true;
  static constexpr std::array<Argument<RotationalSpringDamper>, 10> arguments = {{
      {.name = "I", .slot = &RotationalSpringDamper::i, .required = true, .help = "marker the torque acts on"},
      {.name = "J", .slot = &RotationalSpringDamper::j, .required = true, .help = "marker the reaction acts on"},
      {.name = "KT",
       .slot = &RotationalSpringDamper::stiffness,
       .unit = unit::angular_stiffness,
       .minimum = 0,
       .help = "stiffness"},
      {.name = "CT",
       .slot = &RotationalSpringDamper::damping,
       .unit = unit::angular_damping,
       .minimum = 0,
       .help = "damping"},
      {.name = "ANGLE",
       .slot = &RotationalSpringDamper::free_angle,
       .unit = unit::angle,
       .help = "angle at which TORQUE acts"},
      {.name = "TORQUE", .slot = &RotationalSpringDamper::preload, .unit = unit::torque, .help = "torque at ANGLE"},
      {.name = "K", .slot = &RotationalSpringDamper::elsewhere, .help = "goes with TRANSLATIONAL"},
      {.name = "C", .slot = &RotationalSpringDamper::elsewhere, .help = "goes with TRANSLATIONAL"},
      {.name = "LENGTH", .slot = &RotationalSpringDamper::elsewhere, .help = "goes with TRANSLATIONAL"},
      {.name = "FORCE", .slot = &RotationalSpringDamper::elsewhere, .help = "goes with TRANSLATIONAL"},
  }};

  double stated_torque() const { return preload; }
  bool reads_angle() const { return stiffness != 0; }
  template <class S>
  S about_axis(const S& angle, const S& rate) const {
    return preload - stiffness * (angle - free_angle) - damping * rate;
  }
};

}  // namespace

extern constinit const Kind rotational_spring_damper = axis_torque<RotationalSpringDamper>();

}  // namespace dynalin

// SPRINGDAMPER/id, TRANSLATIONAL, I=, J=, K=, C=, LENGTH=, FORCE=
//
// Spring and damper in parallel along the line of sight between markers I and J.
//
//     F = FORCE − K (d − LENGTH) − C d′          d = |p_JI|, the distance from J to I
//
// F > 0 pushes the markers apart. It acts on I along +p_JI and on J along −p_JI. At d = 0 the line has no
// direction: a spring that is free of force there (LENGTH and FORCE 0) and has no damper is −K p_JI and needs none. A
// damper at rest is no force either, but has no derivative; of any other the analysis says which markers met.
#include "elements/families/line_force.h"

namespace dynalin {

namespace {

struct SpringDamper {
  MarkerId i, j;
  double stiffness = 0;    // [force/length]
  double damping = 0;      // [force·time/length]
  double free_length = 0;  // [length]
  double preload = 0;      // [force] at d = free_length

  ElsewhereOnly elsewhere;

  static constexpr std::string_view keyword = "SPRINGDAMPER", variant = "TRANSLATIONAL";
  static constexpr std::string_view summary = "Spring and damper along the line between two markers.";
  static constexpr bool acts_on_rotation = false;
  static constexpr std::array<Argument<SpringDamper>, 10> arguments = {{
      {.name = "I", .slot = &SpringDamper::i, .required = true, .help = "marker the force acts on"},
      {.name = "J", .slot = &SpringDamper::j, .required = true, .help = "marker the reaction acts on"},
      {.name = "K", .slot = &SpringDamper::stiffness, .unit = unit::stiffness, .minimum = 0, .help = "stiffness"},
      {.name = "C", .slot = &SpringDamper::damping, .unit = unit::damping, .minimum = 0, .help = "damping"},
      {.name = "LENGTH",
       .slot = &SpringDamper::free_length,
       .unit = unit::length,
       .minimum = 0,
       .help = "distance at which FORCE acts"},
      {.name = "FORCE", .slot = &SpringDamper::preload, .unit = unit::force, .help = "force at d = LENGTH"},
      {.name = "KT", .slot = &SpringDamper::elsewhere, .help = "goes with ROTATIONAL"},
      {.name = "CT", .slot = &SpringDamper::elsewhere, .help = "goes with ROTATIONAL"},
      {.name = "ANGLE", .slot = &SpringDamper::elsewhere, .help = "goes with ROTATIONAL"},
      {.name = "TORQUE", .slot = &SpringDamper::elsewhere, .help = "goes with ROTATIONAL"},
  }};

  bool needs_direction() const { return damping != 0 || preload + stiffness * free_length != 0; }
  double stated_force() const { return preload; }
  template <class S>
  S along_line(const TimeTaylor<S>& d) const {
    return preload - stiffness * (d.value - free_length) - damping * d.rate;
  }
};

}  // namespace

extern constinit const Kind spring_damper = line_force<SpringDamper>().with_example("SPRINGDAMPER/1, K=2000");

}  // namespace dynalin

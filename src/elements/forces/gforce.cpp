// GFORCE/id, I=, JFLOAT=, RM=, {FX=\FY=\FZ= | FXYZ=} {TX=\TY=\TZ= | TXYZ=}
//
// A force and torque on I at its origin, with components in the axes of RM; the opposite acts on the body of the
// floating marker JFLOAT at the same point. Components that are not written are zero.
#include "elements/families/vector_force.h"

namespace dynalin {

namespace {

struct GForce : WrittenVectorForce {
  static constexpr std::string_view keyword = "GFORCE";
  static constexpr std::string_view summary =
      "A force and torque on a marker by components, with a reaction on a floating marker.";
  static constexpr Components components = Components::force_and_torque;
  static constexpr std::array<Argument<GForce>, 12> arguments = {{
      {.name = "I", .slot = &GForce::i, .required = true, .help = "marker the force and torque acts on"},
      {.name = "JFLOAT",
       .slot = &GForce::jfloat,
       .required = true,
       .help = "floating marker on the body that takes the reaction"},
      {.name = "RM", .slot = &GForce::rm, .required = true, .help = "marker in whose axes the components are given"},
      {.name = "FX", .slot = &GForce::fx, .unit = unit::force, .help = "along x of RM", .ends = "FXYZ FUNCTION"},
      {.name = "FY", .slot = &GForce::fy, .unit = unit::force, .help = "along y of RM", .ends = "FXYZ FUNCTION"},
      {.name = "FZ", .slot = &GForce::fz, .unit = unit::force, .help = "along z of RM", .ends = "FXYZ FUNCTION"},
      {.name = "TX", .slot = &GForce::tx, .unit = unit::torque, .help = "about x of RM", .ends = "TXYZ FUNCTION"},
      {.name = "TY", .slot = &GForce::ty, .unit = unit::torque, .help = "about y of RM", .ends = "TXYZ FUNCTION"},
      {.name = "TZ", .slot = &GForce::tz, .unit = unit::torque, .help = "about z of RM", .ends = "TXYZ FUNCTION"},
      {.name = "FXYZ",
       .slot = &GForce::fxyz,
       .unit = unit::force,
       .help = "all three as a vector expression",
       .ends = "FX FY FZ FUNCTION"},
      {.name = "TXYZ",
       .slot = &GForce::txyz,
       .unit = unit::torque,
       .help = "all three as a vector expression",
       .ends = "TX TY TZ FUNCTION"},
      {.name = "FUNCTION",
       .slot = &GForce::function,
       .help = "USER(…): a compiled routine gives them all",
       .ends = "FX FY FZ TX TY TZ FXYZ TXYZ"},
  }};
};

constexpr std::array<ValueArgument, 6> components_of_gforce = {{{"FX"}, {"FY"}, {"FZ"}, {"TX"}, {"TY"}, {"TZ"}}};
constexpr auto gforce_routines = routine_of_components<sAdamsGforce>("gfosub", components_of_gforce);

}  // namespace

extern constinit const Kind gforce = vector_force<GForce>().calling(gforce_routines);

}  // namespace dynalin

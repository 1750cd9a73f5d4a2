// VFORCE/id, I=, JFLOAT=, RM=, {FX=\FY=\FZ= | FXYZ=}
//
// A force on I at its origin, with components in the axes of RM; the opposite acts on the body of the floating marker
// JFLOAT at the same point. Components that are not written are zero.
#include "elements/families/vector_force.h"

namespace dynalin {

namespace {

struct VForce : WrittenVectorForce {
  static constexpr std::string_view keyword = "VFORCE";
  static constexpr std::string_view summary =
      "A force on a marker by components, with a reaction on a floating marker.";
  static constexpr Components components = Components::force;
  static constexpr std::array<Argument<VForce>, 8> arguments = {{
      {.name = "I", .slot = &VForce::i, .required = true, .help = "marker the force acts on"},
      {.name = "JFLOAT",
       .slot = &VForce::jfloat,
       .required = true,
       .help = "floating marker on the body that takes the reaction"},
      {.name = "RM", .slot = &VForce::rm, .required = true, .help = "marker in whose axes the components are given"},
      {.name = "FX", .slot = &VForce::fx, .unit = unit::force, .help = "along x of RM", .ends = "FXYZ FUNCTION"},
      {.name = "FY", .slot = &VForce::fy, .unit = unit::force, .help = "along y of RM", .ends = "FXYZ FUNCTION"},
      {.name = "FZ", .slot = &VForce::fz, .unit = unit::force, .help = "along z of RM", .ends = "FXYZ FUNCTION"},
      {.name = "FXYZ",
       .slot = &VForce::fxyz,
       .unit = unit::force,
       .help = "all three as a vector expression",
       .ends = "FX FY FZ FUNCTION"},
      {.name = "FUNCTION",
       .slot = &VForce::function,
       .help = "USER(…): a compiled routine gives them all",
       .ends = "FX FY FZ FXYZ"},
  }};
};

constexpr std::array<ValueArgument, 3> components_of_vforce = {{{"FX"}, {"FY"}, {"FZ"}}};
constexpr auto vforce_routines = routine_of_components<sAdamsVforce>("vfosub", components_of_vforce);

}  // namespace

extern constinit const Kind vforce = vector_force<VForce>().calling(vforce_routines);

}  // namespace dynalin

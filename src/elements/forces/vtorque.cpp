// VTORQUE/id, I=, JFLOAT=, RM=, {TX=\TY=\TZ= | TXYZ=}
//
// A torque on I at its origin, with components in the axes of RM; the opposite acts on the body of the floating marker
// JFLOAT at the same point. Components that are not written are zero.
#include "elements/families/vector_force.h"

namespace dynalin {

namespace {

struct VTorque : WrittenVectorForce {
  static constexpr std::string_view keyword = "VTORQUE";
  static constexpr std::string_view summary =
      "A torque on a marker by components, with a reaction on a floating marker.";
  static constexpr Components components = Components::torque;
  static constexpr std::array<Argument<VTorque>, 8> arguments = {{
      {.name = "I", .slot = &VTorque::i, .required = true, .help = "marker the torque acts on"},
      {.name = "JFLOAT",
       .slot = &VTorque::jfloat,
       .required = true,
       .help = "floating marker on the body that takes the reaction"},
      {.name = "RM", .slot = &VTorque::rm, .required = true, .help = "marker in whose axes the components are given"},
      {.name = "TX", .slot = &VTorque::tx, .unit = unit::torque, .help = "about x of RM", .ends = "TXYZ FUNCTION"},
      {.name = "TY", .slot = &VTorque::ty, .unit = unit::torque, .help = "about y of RM", .ends = "TXYZ FUNCTION"},
      {.name = "TZ", .slot = &VTorque::tz, .unit = unit::torque, .help = "about z of RM", .ends = "TXYZ FUNCTION"},
      {.name = "TXYZ",
       .slot = &VTorque::txyz,
       .unit = unit::torque,
       .help = "all three as a vector expression",
       .ends = "TX TY TZ FUNCTION"},
      {.name = "FUNCTION",
       .slot = &VTorque::function,
       .help = "USER(…): a compiled routine gives them all",
       .ends = "TX TY TZ TXYZ"},
  }};
};

constexpr std::array<ValueArgument, 3> components_of_vtorque = {{{"TX"}, {"TY"}, {"TZ"}}};
constexpr auto vtorque_routines = routine_of_components<sAdamsVtorque>("vtosub", components_of_vtorque);

}  // namespace

extern constinit const Kind vtorque = vector_force<VTorque>().calling(vtorque_routines);

}  // namespace dynalin

// SFORCE/id, TRANSLATIONAL [, ACTIONONLY], I=, J=, FUNCTION=
//
// One force of magnitude f. Along the line from J to I, positive pushes the markers apart: f e on I, −f e on J with
// e = p_JI/|p_JI|. With ACTIONONLY it acts on I alone, along z of J, and J may be on any body.
#include "elements/families/single_component.h"

namespace dynalin {

namespace {

struct SingleForce {
  MarkerId i, j;
  bool action_only = false;
  Expression function;  // [force]

  static constexpr std::string_view variant = "TRANSLATIONAL";
  static constexpr std::string_view summary = "A force of given magnitude between two markers, or on one along z of J.";
  static constexpr bool acts_on_rotation = false;
  static constexpr std::array<Argument<SingleForce>, 4> arguments = {{
      {.name = "I", .slot = &SingleForce::i, .required = true, .help = "marker the force acts on"},
      {.name = "J", .slot = &SingleForce::j, .required = true, .help = "marker the reaction acts on"},
      {.name = "ACTIONONLY", .slot = &SingleForce::action_only, .help = "no reaction on J"},
      {.name = "FUNCTION",
       .slot = &SingleForce::function,
       .required = true,
       .unit = unit::force,
       .help = "the force; above 0 it pushes the markers apart"},
  }};

  Direction direction() const { return action_only ? Direction::along_z : Direction::along_line; }
};

}  // namespace

extern constinit const Kind single_force =
    single_component<SingleForce>().with_example("SFORCE/1, FUNCTION=-300*DZ(20,1)");

}  // namespace dynalin

// SFORCE/id, ROTATIONAL [, ACTIONONLY], I=, J=, FUNCTION=
//
// One torque of magnitude f about z of J: f z_J on I and −f z_J on J; with ACTIONONLY nothing on J. The z axes are
// meant to be parallel; the torque keeps using z_J if they are not.
#include "elements/families/single_component.h"

namespace dynalin {

namespace {

struct SingleTorque {
  MarkerId i, j;
  bool action_only = false;
  Expression function;  // [force·length]

  static constexpr std::string_view variant = "ROTATIONAL";
  static constexpr std::string_view summary = "A torque of given magnitude about the z axis of marker J.";
  static constexpr bool acts_on_rotation = true;
  static constexpr std::array<Argument<SingleTorque>, 4> arguments = {{
      {.name = "I", .slot = &SingleTorque::i, .required = true, .help = "marker the torque acts on"},
      {.name = "J", .slot = &SingleTorque::j, .required = true, .help = "marker the reaction acts on"},
      {.name = "ACTIONONLY", .slot = &SingleTorque::action_only, .help = "no reaction on J"},
      {.name = "FUNCTION",
       .slot = &SingleTorque::function,
       .required = true,
       .unit = unit::torque,
       .help = "the torque on I about z of J"},
  }};

  Direction direction() const { return Direction::about_z; }
};

}  // namespace

extern constinit const Kind single_torque = single_component<SingleTorque>();

}  // namespace dynalin
